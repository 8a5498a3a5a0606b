// The buttons that save: the command's own files, and a picture of the map.

const $ = (id) => document.getElementById(id);

function save(content, name, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** @param from {result, name, picture}: functions @returns an object with enable(whether) */
export function saveButtons(from) {
  const saves = {
    "save-obj": () => save(from.result().obj, `${from.name()}_uv.obj`, "model/obj"),
    "save-svg": () => save(from.result().svg, `${from.name()}.svg`, "image/svg+xml"),
    "save-json": () => save(JSON.stringify(from.result().report, null, 1), `${from.name()}.json`, "application/json"),
    "save-png": async () => save(await from.picture(), `${from.name()}.png`, "image/png"),
  };
  for (const [id, action] of Object.entries(saves)) $(id).addEventListener("click", action);
  return { enable: (whether) => Object.keys(saves).forEach((id) => ($(id).disabled = !whether)) };
}
