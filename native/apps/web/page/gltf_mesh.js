// A GLB file as the command reads meshes: all its triangles as one OBJ, corners at identical positions being one vertex.
import { Mesh, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

/** @returns {name, bytes} of an OBJ file */
export async function objOfGltf(name, buffer) {
  const { scene } = await new GLTFLoader().parseAsync(buffer, "");
  scene.updateMatrixWorld(true);
  const numbers = new Map(), lines = [], point = new Vector3();
  const numberOf = (positions, i, matrix) => {
    const key = point.fromBufferAttribute(positions, i).applyMatrix4(matrix).toArray().join(" ");
    if (!numbers.has(key)) numbers.set(key, numbers.size + 1);
    return numbers.get(key);
  };
  scene.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    const { index, attributes } = node.geometry, count = index ? index.count : attributes.position.count;
    const corner = (i) => numberOf(attributes.position, index ? index.getX(i) : i, node.matrixWorld);
    for (let i = 0; i + 2 < count; i += 3) lines.push(`f ${corner(i)} ${corner(i + 1)} ${corner(i + 2)}`);
  });
  if (!lines.length) throw new Error("The file has no triangles.");
  const text = [...[...numbers.keys()].map((key) => `v ${key}`), ...lines, ""].join("\n");
  return { name: name.replace(/\.glb$/i, ".obj"), bytes: new TextEncoder().encode(text) };
}
