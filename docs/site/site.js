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
  for (const caption of document.querySelectorAll("p.caption[role=heading]")) caption.setAttribute("aria-level", "2");
});
