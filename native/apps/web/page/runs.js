// Runs the command in a worker, which a cancel ends.

let worker = null, running = null, number = 0;

const wasm = fetch("koebe.wasm").then((answer) => answer.arrayBuffer()).then((bytes) => WebAssembly.compile(bytes));
wasm.catch(() => {}); // a run says it

/** Ends the present run, if there is one: its promise is rejected with `cancelled`. */
export const cancelled = new Error("Cancelled.");
export function cancel() {
  if (!running) return;
  worker.terminate();
  worker = null;
  running.reject(cancelled);
  running = null;
}

/**
 * Runs the command on a file.
 * @param job {file: {name, bytes}, command, flags, template} @param progress called with a fraction and the stage
 * @returns {code, lines, report, obj, svg, mesh}: exit code, lines of standard error, what was written
 */
export async function run(job, progress) {
  cancel();
  const own = ++number;
  const module = await wasm;
  if (own !== number) throw cancelled;
  worker ??= new Worker("worker.js");
  const promise = new Promise((resolve, reject) => (running = { resolve, reject }));
  worker.onmessage = ({ data }) => {
    if (data.fraction !== undefined) return progress(data.fraction, data.stage);
    running.resolve(data);
    running = null;
  };
  worker.onerror = (event) => {
    const failed = running;
    running = null;
    worker.terminate();
    worker = null;
    failed.reject(new Error(event.message || "The worker ended."));
  };
  worker.postMessage({ ...job, module });
  return promise;
}
