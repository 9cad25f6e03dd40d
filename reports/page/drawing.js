// Functions that the page of a report and the page of a history share: elements, durations, and charts by
// Vega-Lite.
"use strict";

const element = (id) => document.getElementById(id);

/** Shows a section; sections without data stay hidden. */
const show = (id) => element(id).removeAttribute("hidden");

const duration = (s) => (s < 120 ? `${short(s)} s` : s < 7200 ? `${short(s / 60)} min` : `${short(s / 3600)} h`);

const isDark = matchMedia("screen and (prefers-color-scheme: dark)").matches;

// Okabe and Ito's colours, which colour-blind people can distinguish.
const palette = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#999999", "#8b6f47",
  isDark ? "#9a7fe0" : "#5e3c99", isDark ? "#f2f2f2" : "#1b1b1b", "#a2b627", "#f28e8e"];

const style = getComputedStyle(document.documentElement);
const color = (name) => style.getPropertyValue(name).trim();
const words = { labelColor: color("--ink"), titleColor: color("--ink") };
// Charts write numbers as the tables do.
vega.expressionFunction("digits", (x, many) => (Number.isFinite(x) ? rounded(x, Number(many)) : short(x)));
vega.expressionFunction("share", percent);
const digits = (many) => ({ format: String(many), formatType: "digits" });
const asShare = { formatType: "share" };
const look = { customFormatTypes: true, font: "system-ui, DejaVu Sans, sans-serif", background: "transparent", view: { stroke: color("--line") },
  legend: { orient: "bottom", columns: 8, symbolLimit: 0, labelLimit: 0, ...words }, title: { color: color("--ink") }, header: words,
  axis: { gridColor: color("--line"), domainColor: color("--soft"), tickColor: color("--soft"), ...words } };

const drawn = {};

/**
 * A copy of a value, in which an invisible character is appended to strings such as "constructor", which are
 * names of members that every object has. Vega-Lite would drop such strings from the domain of a scale.
 */
function withoutMembers(value) {
  if (typeof value === "string") return value in {} ? `${value}\u200b` : value;
  if (Array.isArray(value)) return value.map(withoutMembers);
  if (value === null || typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([key, each]) => [key, withoutMembers(each)]));
}

/**
 * Draws a chart, which replaces an earlier chart in the same place. The page's content security policy
 * forbids code from strings, so Vega interprets its expressions instead of compiling them.
 */
async function draw(id, description, spec) {
  const node = element(id);
  node.style.minHeight = `${node.offsetHeight}px`; // keeps the page below from jumping
  drawn[id]?.finalize();
  drawn[id] = await vegaEmbed(node, { $schema: "https://vega.github.io/schema/vega-lite/v6.json", config: look, description, ...withoutMembers(spec) },
    { renderer: "svg", ast: true, actions: { export: true, source: false, compiled: false, editor: false } });
  node.style.minHeight = "";
  node.querySelector("summary").setAttribute("aria-label", "save this chart");
  for (const nameless of node.querySelectorAll("[role=graphics-symbol]:not([aria-label])")) nameless.removeAttribute("role");
}
