// Draws tables with rows of report.json. A click on a heading sorts the rows.
"use strict";

const integer = (n) => n.toLocaleString("en-US");
/**
 * Writes a number with this many significant digits, and with an exponent if the number is below 10^-3 or at
 * least 10^7.
 */
function rounded(x, digits) {
  const size = Math.abs(x);
  if (x !== 0 && (size < 1e-3 || size >= 1e7)) return x.toExponential(digits - 1).replace(/\.?0*e\+?/, "e");
  return Number(x.toPrecision(digits)).toLocaleString("en-US", { maximumFractionDigits: 20 });
}
/** Writes a number with three digits, or with all digits if it is a whole number below ten million. */
const short = (x) =>
  x === null || x === undefined ? "–" : x === Infinity ? "∞" : Number.isInteger(x) && Math.abs(x) < 1e7 ? integer(x) : rounded(x, 3);
/** "1 query", "1,234 queries" */
const counted = (n, one, many) => `${integer(n)} ${n === 1 ? one : many}`;
/**
 * Formats a ratio with three digits, or with more digits if three digits would round a ratio below 1 to 1. If
 * the ratio is in the lowest bin of the histogram, the text says only that it is below the bin's upper
 * border.
 */
function fraction(x) {
  const lowest = report.histogram_borders[1];
  if (x > 0 && x < lowest) return `below ${short(lowest)}`;
  for (let digits = 3; x > 0.9 && x < 1; ++digits)
    if (Number(x.toPrecision(digits)) < 1) return Number(x.toPrecision(digits)).toString();
  return short(x);
}
/** Says how far the primitives of a false positive are apart; `row` says whose bound is the unit. */
function timesTheBound(x, row) {
  // A row without bound_of_distances is a finding of a refuted bound, and only a claimed bound can be
  // refuted.
  const isClaim = row.bound_of_distances === undefined || isOfClaim(row);
  const whose = isClaim ? "its" : "wang's";
  const text = x === Infinity ? `beyond ${isClaim ? "a" : "wang's"} bound of 0` : x > 1 ? `${fraction(x)} times ${whose} bound` : `at ${fraction(x)} of ${whose} bound`;
  return isClaim ? text : `${text} (it claims none)`;
}
const percent = (x) => (x === 0 ? "0" : `${short(100 * x)} %`);
/** A column whose cells are ranges that contain the true numbers. */
const range = (title, field) => ({ title, number: (r) => r[field][1],
  text: (r) => (r[field][1] > 0 ? r[field].map((x) => (Number.isFinite(x) ? rounded(x, 2) : "∞")).join("–") + unitMark(r) : "–") });
const percentRange = ([lo, hi]) => `${short(100 * lo)}–${short(100 * hi)} %`;

/** A new element; `content` is text, a node, or a list of texts and nodes. */
function made(tag, content = [], attributes = {}) {
  const node = document.createElement(tag);
  node.append(...[content].flat());
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  return node;
}

const small = (content) => made("div", content, { class: "small" });

/** "14.8 % (14.4–15.2 %)", or without the interval if the queries are no random sample. */
const rateText = (rate, interval) => percent(rate) + (interval ? ` (${percentRange(interval)})` : "");

/** "4,576 of 30,998". If there are no misses, the upper confidence bound of the rate of misses follows. */
function missedText(counts) {
  const seen = `${integer(counts.false_negatives)} of ${integer(counts.collisions)}`;
  if (counts.false_negatives > 0 || counts.collisions === 0 || counts.false_negative_rate_upper_95 === null) return seen;
  return `${seen}, below ${percent(counts.false_negative_rate_upper_95)} at 95 %`;
}

/**
 * Draws a table.
 * @param columns [{title, text(row): text or node, number(row): the key to sort by, bad(row): whether the
 * cell is marked}]
 * @param sortable whether a click on a heading sorts
 */
function fillTable(table, columns, rows, sortable = false) {
  const draw = () => {
    const body = made("tbody");
    for (const row of rows) {
      const line = body.insertRow();
      for (const column of columns) {
        const cell = line.insertCell();
        cell.append(column.text(row) ?? "");
        if (column.number) cell.classList.add("number");
        if (column.bad?.(row)) cell.classList.add("bad");
      }
    }
    table.tBodies[0]?.remove();
    table.append(body);
  };
  const heading = (column) => {
    const title = made("th", sortable ? made("button", column.title, { type: "button" }) : column.title, { scope: "col" });
    if (column.number) title.classList.add("number");
    if (!sortable) return title;
    title.firstChild.addEventListener("click", () => {
      const up = title.getAttribute("aria-sort") === "descending";
      for (const other of title.parentNode.cells) other.removeAttribute("aria-sort");
      title.setAttribute("aria-sort", up ? "ascending" : "descending");
      const key = column.number ?? column.text;
      rows.sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0) * (up ? 1 : -1));
      draw();
    });
    return title;
  };
  table.replaceChildren();
  table.createTHead().insertRow().append(...columns.map(heading));
  draw();
}

const count = (title, field, bad) => ({
  title, number: (r) => r[field], text: (r) => integer(r[field]), bad: bad ? (r) => r[field] > 0 : undefined,
});
const number = (title, field) => ({ title, number: (r) => r[field] ?? -1, text: (r) => short(r[field]) });
const text = (title, field) => ({ title, text: (r) => r[field] });

/** The columns of keys and measures, by their names in report.json. */
const measures = {
  ...Object.fromEntries(["subject", "kind", "class", "family"].map((key) => [key, text(key, key)])),
  queries: count("queries", "queries"), collisions: count("collisions", "collisions"), false_negatives: count("missed", "false_negatives", true),
  false_positives: count("false positives", "false_positives"), refuted_bounds: count("beyond", "refuted_bounds", true),
  median_fp_distance_over_bound: range("median dist.", "median_fp_distance_over_bound"), q99_fp_distance_over_bound: range("99 % dist.", "q99_fp_distance_over_bound"),
  times_given: count("times", "times_given"), stuck: count("stuck", "stuck"), unknown: count("unknown", "unknown"), ns_per_query: number("ns / query", "ns_per_query"),
};
const columnsOf = (...keys) => keys.map((key) => measures[key]);

/** A button that copies `content`, a text. `title` is text or a node. */
function copyButton(content, title = "copy") {
  const button = made("button", title, { type: "button", class: "copy" });
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(content);
    button.textContent = "copied";
  });
  return button;
}

const command = (content) => made("div", [made("code", content), copyButton(content)]);

/**
 * A button that copies a query as a line that nearmiss oracle and verdict read: its coordinates, then the
 * separation if the query has one.
 */
const copyQuery = (x) => copyButton(x.join(" "));

/**
 * A query as text, with a line for each vertex. The line has the vertex's place at t = 0 and, if the vertex
 * moves, its place at t = 1. The separation follows if the query has one.
 */
function queryText(x) {
  const point = (i) => `(${x.slice(3 * i, 3 * i + 3).join(", ")})`;
  const vertices = Math.floor(x.length / 6);
  const vertex = (_, i) => `x${i} ${point(i)}` + (point(i) === point(vertices + i) ? "" : ` → ${point(vertices + i)}`);
  return made("pre", [...Array.from({ length: vertices }, vertex), ...(separationOf(x) > 0 ? [`h  ${separationOf(x)}`] : [])].join("\n"));
}
