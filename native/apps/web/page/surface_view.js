// The surface in space, with its checker, and its loops as coloured lines.
import { Box3, Color, Group, Mesh, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Line2 } from "three/addons/lines/Line2.js";
import { LineGeometry } from "three/addons/lines/LineGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { onSurface } from "./checker.js";
import { colourOf } from "./geometry.js";

const nearby = 14; // pixels from a loop to the pointer

export class SurfaceView {
  /** @param onHover called with the loop, or part, at the pointer; -1: none */
  constructor(canvas, onHover) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.camera = new PerspectiveCamera(35, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.scene = new Scene();
    this.whole = new Group();
    this.scene.add(this.whole);
    this.mesh = new Mesh(undefined, onSurface());
    this.whole.add(this.mesh);
    this.lines = [];
    canvas.addEventListener("pointermove", (event) => event.buttons === 0 && onHover(this.at(event)));
    canvas.addEventListener("pointerleave", () => onHover(-1));
    canvas.addEventListener("keydown", (event) => this.turn(event));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /** @param keepView true: the same surface again */
  show(geometry, positions, loops, partOfTriangle, keepView) {
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
    this.partOfTriangle = partOfTriangle;
    for (const line of this.lines) {
      this.whole.remove(line);
      line.geometry.dispose();
      line.material.dispose();
    }
    this.lines = loops.map((loop, k) => this.lineOf(loop, k, positions));
    this.whole.add(...this.lines);
    if (!keepView) this.frame(geometry);
    this.draw();
  }

  lineOf({ vertices }, k, positions) {
    const points = [...vertices, vertices[0]].flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]);
    const line = new Line2(new LineGeometry().setPositions(points), new LineMaterial({ color: new Color(colourOf(k)), linewidth: 3 }));
    line.points = points;
    return line;
  }

  /** Looks at the surface from where most of its area faces. */
  frame(geometry) {
    const { center, radius } = geometry.boundingSphere, normals = geometry.attributes.normal, mean = new Vector3();
    for (let i = 0; i < normals.count; i += 3) mean.add(new Vector3().fromBufferAttribute(normals, i));
    const size = new Box3().setFromBufferAttribute(geometry.attributes.position).getSize(new Vector3());
    mean.normalize();
    if (!(mean.lengthSq() > 0.5)) mean.set(0.3, 0.4, 1).normalize();
    this.camera.up.set(0, Math.abs(mean.y) > 0.9 ? 0 : 1, Math.abs(mean.y) > 0.9 ? 1 : 0);
    if (size.z > 1.2 * size.y && Math.abs(mean.z) < 0.9) this.camera.up.set(0, 0, 1);
    const away = 1.08 * radius / Math.sin((this.camera.fov * Math.PI) / 360);
    this.camera.near = away / 100;
    this.camera.far = 10 * away;
    this.camera.position.copy(center).addScaledVector(mean, away);
    this.controls.target.copy(center);
    this.controls.update();
    this.resize();
  }

  light(k) {
    this.lines.forEach((line, i) => (line.material.linewidth = i === k ? 8 : 3));
    this.draw();
  }

  /** The loop near the pointer, or the part below it. */
  at(event) {
    const box = this.canvas.getBoundingClientRect();
    const pointer = new Vector2(event.clientX - box.left, event.clientY - box.top);
    if (this.partOfTriangle) {
      const ray = new Raycaster();
      ray.setFromCamera(new Vector2((2 * pointer.x) / box.width - 1, 1 - (2 * pointer.y) / box.height), this.camera);
      const hit = ray.intersectObject(this.mesh)[0];
      return hit ? this.partOfTriangle[Math.floor(hit.face.a / 3)] : -1;
    }
    let best = -1, least = nearby;
    const point = new Vector3();
    this.lines.forEach(({ points }, k) => {
      for (let i = 0; i < points.length; i += 3) {
        point.fromArray(points, i).project(this.camera);
        const away = Math.hypot(((1 + point.x) / 2) * box.width - pointer.x, ((1 - point.y) / 2) * box.height - pointer.y);
        if (away < least) [best, least] = [k, away];
      }
    });
    return best;
  }

  turn(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const zoom = { "+": 0.9, "=": 0.9, "-": 1.1 }[event.key];
    if (!turns && !zoom) return;
    event.preventDefault();
    const offset = this.camera.position.clone().sub(this.controls.target);
    if (zoom) offset.multiplyScalar(zoom);
    else {
      const up = this.camera.up.clone().normalize(), side = new Vector3().crossVectors(up, offset).normalize();
      offset.applyAxisAngle(up, 0.15 * turns[0]).applyAxisAngle(side, 0.15 * turns[1]);
    }
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.zoom = Math.min(1, this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.mesh.geometry.attributes.position) this.renderer.render(this.scene, this.camera);
  }
}
