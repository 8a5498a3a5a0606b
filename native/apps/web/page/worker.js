// The worker: runs the command on files in memory. Each run has a new instance, so that no memory is left of the last one.
// koebe.js stands before this text.

const out = "/out/mapped.obj", json = "/out/report.json", svg = "/out/circles.svg", template = "/template.json";

/** The lines that a terminal would show; progress is the line that is drawn again and again. */
class Terminal {
  lines = [];
  rest = "";
  constructor(progress) {
    this.progress = progress;
  }
  receive(text) {
    const shown = /\r\x1b\[K *(\d+)% ([^\r\n]*)$/.exec(text);
    if (shown) return this.progress(shown[1] / 100, shown[2]);
    const parts = (this.rest + text.replaceAll("\r\x1b[K", "")).split("\n");
    this.rest = parts.pop();
    this.lines.push(...parts);
  }
}

async function commandOf(module, terminal) {
  const command = await koebeModule({
    instantiateWasm(imports, receive) {
      WebAssembly.instantiate(module, imports).then((instance) => receive(instance));
      return {};
    },
    print() {},
    stdin: () => null,
    quit(_, end) {
      throw end;
    },
  });
  const stream = command.FS.streams[2], decoder = new TextDecoder();
  stream.tty = true; // so that progress is shown
  stream.stream_ops = {
    ...stream.stream_ops,
    write(_, bytes, begin, count) {
      terminal.receive(decoder.decode(bytes.slice(begin, begin + count), { stream: true }));
      return count;
    },
  };
  return command;
}

function drawnMesh(command, path) {
  if (!command.ccall("koebe_draw", "number", ["string"], [path])) return null;
  const array = (heap, pointer, count) => heap().slice(pointer / 4, pointer / 4 + count);
  const vertices = command._koebe_vertex_count(), triangles = command._koebe_triangle_count();
  const floats = () => command.HEAPF32, wholes = () => command.HEAP32;
  return {
    positions: array(floats, command._koebe_positions(), 3 * vertices),
    corners: array(wholes, command._koebe_corners(), 3 * triangles),
    faces: array(wholes, command._koebe_faces(), triangles),
    uvs: command._koebe_has_uvs() ? array(floats, command._koebe_uvs(), 6 * triangles) : null,
  };
}

/** The command on a file; see run() in runs.js. */
async function runCommand({ module, file, command: name, flags, circles }, progress) {
  const terminal = new Terminal(progress);
  const command = await commandOf(module, terminal);
  const input = `/in/${file.name}`;
  for (const folder of ["/in", "/out"]) command.FS.mkdir(folder);
  command.FS.writeFile(input, file.bytes);
  if (circles) command.FS.writeFile(template, JSON.stringify({ circles }));
  let code;
  try {
    code = command.callMain([name, input, ...(circles ? [template] : []), out, "--json", json, "--svg", svg, ...flags]);
  } catch (error) {
    if (error.status === undefined) throw error;
    code = error.status; // it has ended itself
  }
  if (terminal.rest) terminal.lines.push(terminal.rest);
  const read = (path, options) => (command.FS.analyzePath(path).exists ? command.FS.readFile(path, options) : null);
  const text = (path) => read(path, { encoding: "utf8" });
  const obj = read(out);
  return {
    code, lines: terminal.lines.map((line) => line.replaceAll(input, file.name)), obj, svg: text(svg), report: JSON.parse(text(json) ?? "null"),
    mesh: drawnMesh(command, obj ? out : input),
  };
}

if (typeof self !== "undefined" && typeof process === "undefined")
  self.onmessage = async ({ data }) => {
    const post = (fraction, stage) => self.postMessage({ fraction, stage });
    self.postMessage(await runCommand(data, post));
  };
else module.exports = { runCommand };
