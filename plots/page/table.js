// The records of the last run: sorted by a column head, filtered by words.

// Without a value always last, whichever way.
function sorted(rows, key, sign) {
  if (!key) return rows;
  const names = new Intl.Collator("en", {numeric: true});
  return [...rows].sort((a, b) => {
    const [left, right] = [a[key], b[key]];
    if (left === undefined || right === undefined)
      return (left === undefined) - (right === undefined);
    return sign * (typeof left === "number" ? left - right : names.compare(left, right));
  });
}

function cell(row, {key, numeric}) {
  const value = row[key];
  if (key === "method") return element("th", {scope: "row"}, show(key, value));
  if (key !== "status") return element("td", {class: numeric && "number"}, show(key, value));
  const reason = row.status_reason && value !== "ok" ?
      element("span", {class: "reason"}, row.status_reason) :
      null;
  return element(
      "td", {}, element("span", {class: `status ${value}`}, value.replace(/_/g, " ")), reason);
}

// sortBy: called with the new order when a head is used.
function fillTable({columns, rows}, sort, sortBy) {
  const key = sort.replace(/^-/, ""), descending = sort.startsWith("-");
  const shown =
      sorted(rows.filter((row) => isShown(row, row.status)), key, descending ? -1 : 1);
  const own = columns.map(
      (column) => ({...column, numeric: rows.some((row) => typeof row[column.key] === "number")}));
  const heads = own.map((column) => {
    const here = column.key === key;
    const arrow = here ? (descending ? " ↓" : " ↑") : "";
    const button = element("button", {type: "button"}, column.name, arrow);
    const next = !here ? column.key : descending ? "" : `-${column.key}`;
    button.addEventListener("click", () => sortBy(next));
    return element(
        "th", {
          scope: "col",
          "data-key": column.key,
          class: column.numeric && "number",
          "aria-sort": here && (descending ? "descending" : "ascending")
        },
        button);
  });
  const lines =
      shown.map((row) => element("tr", {}, ...own.map((column) => cell(row, column))));
  const focused = document.activeElement && document.activeElement.closest("th[data-key]");
  const table = document.getElementById("table");
  table.replaceChildren(
      element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...lines));
  if (focused) table.querySelector(`th[data-key="${focused.dataset.key}"] button`).focus();
  document.getElementById("count").textContent = shown.length === rows.length ?
      `${rows.length} cases` :
      `${shown.length} of ${rows.length} cases`;
}

function fillContext(context) {
  const line = ({key, value, before, differs}) => element(
      "tr", {class: differs && "differs", "data-key": key},
      element("th", {scope: "row"}, differs ? `◆ ${key}` : key),
      element("td", {}, show(key, value)),
      element("td", {class: "before"}, differs ? `before: ${show(key, before)}` : ""));
  document.getElementById("context").replaceChildren(element("tbody", {}, ...context.map(line)));
}
