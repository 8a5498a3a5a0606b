// A click on a heading of a table of the class "sortable", or Enter on it, sorts by its column, and once more turns round.
"use strict";
document.addEventListener("DOMContentLoaded", () => {
  for (const table of document.querySelectorAll("table.sortable")) {
    const heads = [...table.tHead.rows[0].cells];
    const sort = (head, column) => {
      const sign = head.ariaSort === "ascending" ? -1 : 1;
      const key = (row) => row.cells[column].textContent.trim();
      const order = (a, b) => (key(a) - key(b) || key(a).localeCompare(key(b))) * sign;  // NaN: not two numbers
      heads.forEach((other) => other.setAttribute("aria-sort", "none"));
      head.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
      table.tBodies[0].append(...[...table.tBodies[0].rows].sort(order));
    };
    heads.forEach((head, column) => {
      head.tabIndex = 0;
      head.addEventListener("click", () => sort(head, column));
      head.addEventListener("keydown", (event) => event.key === "Enter" && sort(head, column));
    });
  }
});
// What the theme leaves out for keyboards and readers of screens: boxes that scroll take the focus, captions have a level.
document.addEventListener("DOMContentLoaded", () => {
  for (const box of document.querySelectorAll("pre, .table-wrapper, div.math")) box.tabIndex = 0;
  for (const part of document.querySelectorAll(".sig dl, .sig dd")) part.role = "presentation";  // lines of a signature
  for (const caption of document.querySelectorAll("p.caption[role=heading]")) caption.setAttribute("aria-level", "2");
});
// A list of the versions that stand beside this site (versions.txt, a line each), under the name in the sidebar.
document.addEventListener("DOMContentLoaded", async () => {
  const root = new URL(document.documentElement.dataset.content_root, location.href);
  for (const home of [root, new URL("../", root)]) {  // this is the newest site, or one of the folders
    const answer = await fetch(new URL("versions.txt", home)).catch(() => null);
    if (!answer?.ok) continue;
    const list = document.createElement("select");
    list.ariaLabel = "Version";
    list.append(new Option("newest", home.href));
    for (const name of (await answer.text()).split("\n").filter(Boolean)) list.append(new Option(name, new URL(`${name}/`, home).href));
    list.value = root.href;
    list.addEventListener("change", () => location.assign(list.value + "index.html"));
    document.querySelector(".sidebar-brand").after(list);
    return;
  }
});
