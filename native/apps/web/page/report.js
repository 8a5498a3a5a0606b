// The report beside the views: figures, warnings, and a button for each loop.
import { colourOf } from "./geometry.js";

const $ = (id) => document.getElementById(id);

const element = (tag, text) => Object.assign(document.createElement(tag), { textContent: text });

function figuresOf(report) {
  const degrees = `${report.angle_error_deg.mean.toPrecision(3)}°`;
  const rows = [["Angle error", degrees], ["Flipped faces", String(report.flipped)]];
  const mu = report.fit?.mu;
  if (mu) rows.push(["Bent by |µ|", `${mu.mean.toPrecision(2)}, at most ${mu.max.toPrecision(2)}`]);
  if (report.density_ratio_5_95) rows.push(["Texel density", `within a factor ${report.density_ratio_5_95.toPrecision(3)}`]);
  if (report.mean_roundness) rows.push(["Mean roundness", report.mean_roundness.all.toExponential(1)]);
  return rows;
}

/** @param report null: nothing was mapped @param light called with a loop while its button has the focus or the pointer */
export function showFigures(report, loops, light) {
  $("figures").replaceChildren(...(report ? figuresOf(report) : []).flatMap(([name, value]) => [element("dt", name), element("dd", value)]));
  $("warnings").replaceChildren(...(report?.warnings ?? []).map(({ text }) => element("li", text)));
  $("loops").replaceChildren(...loops.map((loop, k) => buttonOf(loop, k, light)));
}

function buttonOf({ radius, vertices }, k, light) {
  const button = element("button", k === 0 ? "Rim" : `Hole ${k}`);
  button.type = "button";
  button.dataset.loop = k;
  button.title = `${vertices.length} vertices, radius ${radius.toFixed(4)}`;
  button.style.setProperty("--of-loop", colourOf(k));
  for (const [begin, end] of [["pointerenter", "pointerleave"], ["focus", "blur"]]) {
    button.addEventListener(begin, () => light(k));
    button.addEventListener(end, () => light(-1));
  }
  const item = document.createElement("li");
  item.append(button);
  return item;
}
