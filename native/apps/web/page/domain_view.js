// The map: its checker, and the circles over it. Circles are dragged to other places, the disk by a Möbius map.
import { Mesh, OrthographicCamera, Scene, WebGLRenderer } from "three";
import { inDomain, shared } from "./checker.js";
import { colourOf, triangleAt } from "./geometry.js";
import { image, taking } from "./moebius.js";

const margin = 1.05; // half of what is seen
const step = 0.02; // of an arrow key
const room = 0.01; // that dragged circles keep

export class DomainView {
  /** @param on {hover(k), preview(), moveCircles(circles), moveDisk(a)}: functions */
  constructor(canvas, svg, on) {
    Object.assign(this, { canvas, svg, on, circles: [], mesh: null });
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.camera = new OrthographicCamera(-margin, margin, margin, -margin, -1, 1);
    this.scene = new Scene();
    this.drawn = new Mesh(undefined, inDomain());
    this.drawn.frustumCulled = false;
    this.scene.add(this.drawn);
    svg.addEventListener("pointerdown", (event) => this.begin(event));
    svg.addEventListener("pointermove", (event) => this.move(event));
    svg.addEventListener("pointerup", (event) => this.end(event));
    svg.addEventListener("pointercancel", () => this.undo());
    svg.addEventListener("pointerleave", () => this.grabbed || on.hover(-1));
    svg.addEventListener("focusin", ({ target }) => target.dataset.loop && on.hover(Number(target.dataset.loop)));
    svg.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  /** @param loops with center and radius, the outer one first; none: parts */
  show(geometry, mesh, loops, partOfTriangle) {
    this.drawn.geometry.dispose();
    this.drawn.geometry = geometry;
    Object.assign(this, { mesh, partOfTriangle, circles: loops.map(({ center, radius }) => ({ center, radius })) });
    shared.moved.value.set(0, 0);
    this.makeCircles();
    this.draw();
  }

  makeCircles() {
    this.svg.replaceChildren(
      ...this.circles.map((circle, k) => {
        const element = document.createElementNS("http://www.w3.org/2000/svg", "circle");
        element.classList.add(k === 0 ? "rim" : "hole");
        element.dataset.loop = k;
        element.style.setProperty("--of-loop", colourOf(k));
        element.setAttribute("stroke", colourOf(k));
        if (k > 0) {
          element.setAttribute("tabindex", "0");
          element.setAttribute("role", "button");
          element.setAttribute("aria-label", `Hole ${k}, radius ${circle.radius.toFixed(3)}. Arrow keys move it, Enter maps again.`);
        }
        return element;
      }),
    );
    this.placeCircles();
  }

  placeCircles() {
    const moved = shared.moved.value.toArray();
    this.circles.forEach((circle, k) => {
      const { center, radius } = k === 0 ? circle : image(moved, circle), element = this.svg.children[k];
      for (const [name, value] of [["cx", center[0]], ["cy", -center[1]], ["r", radius]]) element.setAttribute(name, value);
    });
  }

  light(k) {
    for (const element of this.svg.children) element.classList.toggle("lit", Number(element.dataset.loop) === k);
    this.draw();
  }

  pointOf(event) {
    const box = this.svg.getBoundingClientRect(), size = Math.min(box.width, box.height) / (2 * margin);
    return [(event.clientX - box.left - box.width / 2) / size, -(event.clientY - box.top - box.height / 2) / size];
  }

  begin(event) {
    if (!this.circles.length) return;
    const loop = Number(event.target.dataset?.loop ?? 0), at = this.pointOf(event);
    if (loop === 0 && Math.hypot(...at) > 0.97) return;
    this.svg.setPointerCapture(event.pointerId);
    this.on.hover(loop || -1); // a finger does not hover
    this.grabbed = { loop, at, from: loop > 0 ? this.circles[loop].center : null };
  }

  move(event) {
    const at = this.pointOf(event);
    if (!this.grabbed) return this.on.hover(this.hovered(event, at));
    const { loop, at: begin, from } = this.grabbed;
    if (loop > 0) this.place(loop, [from[0] + at[0] - begin[0], from[1] + at[1] - begin[1]]);
    else {
      const size = Math.max(1, Math.hypot(...at) / 0.95);
      shared.moved.value.set(...taking(begin, [at[0] / size, at[1] / size]));
      this.placeCircles();
    }
    this.grabbed.moved = true;
    this.draw();
    this.on.preview();
  }

  hovered(event, at) {
    if (event.target.dataset?.loop > 0 || event.target.classList?.contains("rim")) {
      const loop = Number(event.target.dataset.loop);
      return loop > 0 || Math.hypot(...at) > 0.96 ? loop : -1;
    }
    if (!this.partOfTriangle) return -1;
    const triangle = triangleAt(this.mesh, at);
    return triangle < 0 ? -1 : this.partOfTriangle[triangle];
  }

  /** Puts a circle where it meets no other one. */
  place(loop, center) {
    const { radius } = this.circles[loop], away = Math.hypot(...center), most = 1 - radius - room;
    if (away > most) center = center.map((x) => (x * most) / away);
    const meets = this.circles.some((other, k) => k > 0 && k !== loop &&
      Math.hypot(other.center[0] - center[0], other.center[1] - center[1]) < other.radius + radius + room);
    if (meets) return;
    this.circles[loop] = { center, radius };
    this.placeCircles();
  }

  end() {
    const grabbed = this.grabbed;
    this.grabbed = null;
    if (!grabbed?.moved) return;
    if (grabbed.loop > 0) this.on.moveCircles(this.circles);
    else this.on.moveDisk(shared.moved.value.toArray());
  }

  undo() {
    this.grabbed = null;
  }

  key(event) {
    const loop = Number(event.target.dataset.loop ?? 0);
    const way = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key];
    if (loop > 0 && event.key === "Enter") return this.on.moveCircles(this.circles);
    if (!loop || !way) return;
    event.preventDefault();
    const { center } = this.circles[loop];
    this.place(loop, [center[0] + way[0], center[1] + way[1]]);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const size = Math.min(width, height);
    const [x, y] = [(margin * width) / size, (margin * height) / size];
    Object.assign(this.camera, { left: -x, right: x, top: y, bottom: -y });
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    const mapped = this.drawn.geometry.attributes.position && shared.mapped.value > 0;
    this.canvas.style.visibility = mapped ? "" : "hidden";
    if (mapped) this.renderer.render(this.scene, this.camera);
  }

  /** A square picture of the UVs, for a texture. @returns a promise of a Blob */
  async picture(size) {
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(size, size, false);
    Object.assign(this.camera, { left: -1, right: 1, top: 1, bottom: -1 });
    this.camera.updateProjectionMatrix();
    this.draw();
    const blob = await new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
    this.resize();
    return blob;
  }
}
