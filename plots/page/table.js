// The records of the last run: sorted by a column head, filtered by words.

const isNumber = (rows, key) => rows.some((row) => typeof row[key] === "number");

// Without a value always last, whichever way.
function sorted(rows, sort) {
  const key = sort.replace(/^-/, ""), sign = sort.startsWith("-") ? -1 : 1;
  if (!key) return rows;
  const names = new Intl.Collator("en", {numeric: true});
  return [...rows].sort((a, b) => {
    const [left, right] = [a[key], b[key]];
    if (left === undefined || right === undefined)
      return (left === undefined) - (right === undefined);
    return sign * (typeof left === "number" ? left - right : names.compare(left, right));
  });
}

function cell(row, column, numeric) {
  const value = row[column.key];
  if (column.key === "method") return element("th", {scope: "row"}, show(column.key, value));
  if (column.key !== "status")
    return element("td", {class: numeric && "number"}, show(column.key, value));
  const reason = row.status_reason && value !== "ok" ?
      element("span", {class: "reason"}, row.status_reason) :
      null;
  return element(
      "td", {}, element("span", {class: `status ${value}`}, value.replace(/_/g, " ")), reason);
}

// sortBy: called with the new order when a head is used.
function fillTable(data, state, sortBy) {
  const {columns, rows} = data, matches = matcher(state.filter);
  const shown = sorted(rows.filter((row) => matches(`${wordsOf(row)} ${row.status}`)), state.sort);
  const key = state.sort.replace(/^-/, ""), descending = state.sort.startsWith("-");
  const heads = columns.map((column) => {
    const here = column.key === key;
    const arrow = here ? (descending ? " ↓" : " ↑") : "";
    const button = element("button", {type: "button"}, column.name, arrow);
    const next = !here ? column.key : descending ? "" : `-${column.key}`;
    button.addEventListener("click", () => sortBy(next));
    return element(
        "th", {
          scope: "col",
          "data-key": column.key,
          class: isNumber(rows, column.key) && "number",
          "aria-sort": here && (descending ? "descending" : "ascending")
        },
        button);
  });
  const numeric =
      Object.fromEntries(columns.map((column) => [column.key, isNumber(rows, column.key)]));
  const lines = shown.map(
      (row) =>
          element("tr", {}, ...columns.map((column) => cell(row, column, numeric[column.key]))));
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
