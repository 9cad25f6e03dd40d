// Draws the report: nothing here computes what report.json does not say.
"use strict";

const report = JSON.parse(document.getElementById("report").textContent);
const element = (id) => document.getElementById(id);

/** [{subject, kind, family, ...counts}]; family is "" for the sum over families. */
function countRows(byFamily) {
  const rows = [];
  for (const [subject, ofKind] of Object.entries(report.subjects))
    for (const [kind, counts] of Object.entries(ofKind)) {
      const families = byFamily ? counts.families : { "": counts };
      for (const [family, each] of Object.entries(families)) rows.push({ subject, kind, family, ...each });
    }
  return rows;
}

// --- tables ---------------------------------------------------------------------------------------

const integer = (n) => n.toLocaleString("en-US");
const short = (x) =>
  x === null || x === undefined ? "–" : Number.isInteger(x) ? integer(x) : Number(x.toPrecision(3)).toString();

/** columns: {title, text(row), number: value(row) for sorting, bad(row)} */
function fillTable(table, columns, rows, sortable = false) {
  const draw = () => {
    const body = document.createElement("tbody");
    for (const row of rows) {
      const line = body.insertRow();
      for (const column of columns) {
        const cell = line.insertCell();
        const content = column.text(row);
        if (content instanceof Node) cell.append(content);
        else cell.textContent = content;
        if (column.number) cell.classList.add("number");
        if (column.bad && column.bad(row)) cell.classList.add("bad");
      }
    }
    table.tBodies[0]?.remove();
    table.append(body);
  };
  table.replaceChildren();
  const head = table.createTHead().insertRow();
  for (const column of columns) {
    const title = document.createElement("th");
    title.textContent = column.title;
    if (column.number) title.classList.add("number");
    if (sortable)
      title.addEventListener("click", () => {
        const up = title.getAttribute("aria-sort") === "descending";
        for (const other of head.cells) other.removeAttribute("aria-sort");
        title.setAttribute("aria-sort", up ? "ascending" : "descending");
        const key = column.number ?? column.text;
        rows.sort((a, b) => (key(a) < key(b) ? -1 : key(a) > key(b) ? 1 : 0) * (up ? 1 : -1));
        draw();
      });
    head.append(title);
  }
  draw();
}

const count = (title, field, bad) => ({
  title, number: (r) => r[field], text: (r) => integer(r[field]), bad: bad ? (r) => r[field] > 0 : undefined,
});
const figure = (title, field) => ({ title, number: (r) => r[field] ?? -1, text: (r) => short(r[field]) });
const text = (title, field) => ({ title, text: (r) => r[field] });

/** How often there was no answer, and why; empty columns are left out. */
const faults = (r) => Object.values(r.faults).reduce((a, b) => a + b, 0);
const noAnswer = {
  title: "no answer", number: faults, bad: (r) => faults(r) > 0,
  text: (r) => Object.entries(r.faults).map(([why, times]) => `${integer(times)} ${why}`).join(", ") || "0",
};
const quantile = (title, field) => ({ title, number: (r) => r.times[field] ?? -1, text: (r) => short(r.times[field]) });

function drawCounts() {
  const byFamily = element("by-family").checked;
  const rows = countRows(byFamily);
  const columns = [
    text("subject", "subject"), text("kind", "kind"), ...(byFamily ? [text("family", "family")] : []),
    count("queries", "queries"), count("collisions", "collisions"), count("false negatives", "false_negatives", true),
    figure("rate below", "false_negative_rate_upper_95"), count("false positives", "false_positives"),
    figure("max distance/bound", "max_fp_distance_over_bound"), count("beyond", "refuted_bounds", true),
    ...(rows.some(faults) ? [noAnswer] : []),
    figure("ns / query", "ns_per_query"), quantile("median ns", "median_ns"), quantile("99 % ns", "q99_ns"),
  ];
  fillTable(element("counts"), columns, rows, true);
}

function code(content) {
  const node = document.createElement("code");
  node.textContent = content;
  return node;
}

/** A vertex a line: where it is at t = 0, and where it is at t = 1 if it moves. */
function drawQuery(x) {
  const node = document.createElement("pre");
  const point = (i) => `(${x.slice(3 * i, 3 * i + 3).join(", ")})`;
  const vertex = (i) => `x${i} ${point(i)}` + (point(i) === point(4 + i) ? "" : ` → ${point(4 + i)}`);
  node.textContent = [0, 1, 2, 3].map(vertex).join("\n");
  return node;
}

/** A button that copies a query as a line of 24 numbers, for nearmiss oracle and verdict. */
function copyButton(x) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "copy";
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(x.join(" "));
    button.textContent = "copied";
  });
  return button;
}

/** How to see it again, the shrunk query, and, when asked for, the query as it was found. */
function drawShrunk(finding) {
  const node = document.createElement("div");
  const original = document.createElement("details");
  original.append(document.createElement("summary"), drawQuery(finding.original));
  original.firstChild.textContent = finding.original_file;
  node.append(code(`nearmiss replay ${finding.file}${finding.subject ? " --subject " + finding.subject : ""}`),
    copyButton(finding.shrunk), drawQuery(finding.shrunk), original);
  return node;
}

function drawFindings() {
  const seen = report.signatures.reduce((sum, each) => sum + each.seen, 0);
  element("findings-note").textContent = seen === 0
    ? "None: no false negative, no bound refuted, no disagreement."
    : `${integer(seen)} failures in ${integer(report.signatures.length)} ways. A few of each are kept, shrunk to the simplest query ` +
      "that fails in the same way; they are in findings.csv and stand as case files in cases/, beside the queries as they " +
      "were found. The commands work in this report's folder.";
  if (seen === 0) return;
  fillTable(element("findings"), [
    { title: "t = 0, contact or closest, t = 1", text: (r) => drawPicture(r.kind, r.shrunk, r.time) },
    { title: "what", text: (r) => r.what + (r.ratio ? `, at ${short(r.ratio)} of the bound` : "") },
    text("subject", "subject"), text("in which way", "signature"), count("times seen", "seen"),
    text("from", "provenance"), { title: "shrunk", text: drawShrunk },
  ], report.findings);
}

function drawFarthest() {
  const rows = countRows(false).flatMap((r) => r.farthest.map((far) => ({ subject: r.subject, kind: r.kind, ...far })));
  fillTable(element("farthest"), [
    text("subject", "subject"), text("kind", "kind"), figure("distance / bound", "ratio"), text("from", "provenance"),
  ], rows);
}

function drawOracle() {
  const rows = [];
  for (const [kind, families] of Object.entries(report.oracle.families ?? {}))
    for (const [family, counts] of Object.entries(families)) rows.push({ kind, family, ...counts.decided_by, ...counts });
  const stages = Object.keys(report.oracle.total.decided_by);
  fillTable(element("oracle"), [
    text("kind", "kind"), text("family", "family"), count("queries", "queries"), count("collisions", "collisions"),
    ...stages.map((stage) => count(stage, stage)), count("near bounds", "near_bounds"), count("asked of all three", "compared"),
    count("collisions", "compared_collisions"), count("with even roots", "missed_by_parity"),
  ], rows);
}

function drawTightness() {
  const rows = Object.entries(report.tightness ?? {}).map(([name, extreme]) => ({ name, ...extreme }));
  if (rows.length === 0) return;
  element("tightness-section").hidden = false;
  const says = { "accepting-tolerance": "missed with this factor or less", "keeping-tolerance": "missed with this factor or more",
    distance: "distance / bound" };
  fillTable(element("tightness"), [
    text("tolerance or tests", "name"), { title: "figure", text: (r) => says[r.of] },
    { title: "value", number: (r) => r.value ?? 0, text: (r) => (r.value === null ? "none found" : short(r.value)) },
    count("queries", "queries"), { title: "from", text: (r) => r.provenance ?? "" },
  ], rows);
}

function drawBaseline() {
  const baseline = report.baseline;
  if (!baseline) return;
  element("baseline").hidden = false;
  element("baseline-new").textContent = baseline.new_signatures.length === 0
    ? "No way to fail that the baseline does not have."
    : `New: ${baseline.new_signatures.map((each) => `${each.what} of ${each.subject || "the oracle"}, ${each.signature}`).join("; ")}.`;
  element("baseline-new").classList.toggle("bad", baseline.new_signatures.length > 0);
  const pair = (title, field) => ({
    title, number: (r) => r.now[field], text: (r) => `${short(r.before?.[field])} → ${short(r.now[field])}`,
  });
  fillTable(element("baseline-table"), [
    text("subject", "subject"), text("kind", "kind"), pair("false negatives", "false_negatives"),
    pair("false-positive rate", "false_positive_rate"), pair("max distance / bound", "max_fp_distance_over_bound"),
    pair("ns / query", "ns_per_query"),
  ], baseline.changes);
}

// --- head -----------------------------------------------------------------------------------------

function drawHead() {
  element("runs").textContent = report.runs
    .map((run) => [run.command, run.scene, run.families && `families ${run.families}`, run.seed && `seed ${run.seed}`,
      run.started, run.missing && `incomplete: ${run.missing}`, `nearmiss ${run.version}`,
      ...run.environments.map((each) => `${each.compiler} ${each.flags}, rounding ${each.rounding}, ${each.cpu}`)].filter(Boolean).join(", "))
    .join(" · ");
  const lines = report.verdicts.map((v) => ({ name: v.subject, bad: !v.clean, text: v.text }));
  if (report.oracle.complaint) lines.unshift({ name: "oracle", bad: true, text: report.oracle.complaint });
  for (const line of lines) {
    const node = document.createElement("div");
    node.className = line.bad ? "verdict bad" : "verdict";
    for (const [name, content] of [["mark", line.bad ? "FAIL" : "ok"], ["subject", line.name], ["text", line.text]]) {
      const part = document.createElement("span");
      part.className = name;
      part.textContent = content;
      node.append(part);
    }
    element("verdicts").append(node);
  }
}

// --- charts ---------------------------------------------------------------------------------------

const subjects = Object.keys(report.subjects);
// Okabe and Ito's colours, which the colour-blind can tell apart.
const palette = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#999999", "#8b6f47"];
const subjectColor = {
  field: "subject", type: "nominal", title: "subject",
  scale: { domain: subjects, range: subjects.map((_, i) => palette[i % palette.length]) },
};
const style = getComputedStyle(document.documentElement);
const color = (name) => style.getPropertyValue(name).trim();
const words = { labelColor: color("--ink"), titleColor: color("--ink") };
const look = { font: "system-ui, DejaVu Sans, sans-serif", background: "transparent", view: { stroke: color("--line") },
  legend: { orient: "bottom", columns: 8, ...words }, title: { color: color("--ink") }, header: words,
  axis: { gridColor: color("--line"), domainColor: color("--soft"), tickColor: color("--soft"), ...words } };

function draw(id, spec) {
  return vegaEmbed("#" + id, { $schema: "https://vega.github.io/schema/vega-lite/v6.json", config: look, ...spec },
    { renderer: "svg", actions: { export: true, source: false, compiled: false, editor: false } });
}

function drawErrorTime() {
  const points = subjects.map((subject) => {
    const sum = { queries: 0, collisions: 0, false_negatives: 0, false_positives: 0, ns: 0 };
    for (const c of Object.values(report.subjects[subject])) {
      for (const field of ["queries", "collisions", "false_negatives", "false_positives"]) sum[field] += c[field];
      sum.ns += (c.ns_per_query ?? 0) * c.queries;
    }
    return {
      subject, ns: sum.ns / sum.queries,
      missed: (100 * sum.false_negatives) / Math.max(1, sum.collisions),
      alarms: (100 * sum.false_positives) / Math.max(1, sum.queries - sum.collisions),
    };
  }).filter((p) => p.ns > 0);
  const panel = (field, title) => ({
    width: 420, height: 260, title,
    mark: { type: "point", filled: true, size: 130, opacity: 0.85 },
    encoding: {
      x: { field: "ns", type: "quantitative", title: "ns a query", scale: { type: "log", nice: false, padding: 30 },
        axis: { grid: true, tickCount: 6, format: "~s" } },
      y: { field, type: "quantitative", title: "%", scale: { type: "symlog", constant: 0.01, domainMin: 0, nice: true },
        axis: { tickCount: 6 } },
      color: subjectColor,
      shape: { field: "subject", type: "nominal", title: "subject", scale: { domain: subjects } },
      tooltip: [{ field: "subject" }, { field: "ns", title: "ns a query", format: ".4~g" },
        { field: "missed", title: "missed, %", format: ".4~g" }, { field: "alarms", title: "false positives, %", format: ".4~g" }],
    },
  });
  return draw("error-time", {
    data: { values: points },
    hconcat: [panel("missed", "missed, % of the collisions"), panel("alarms", "false positives, % of all else")],
  });
}

function drawDistances() {
  const borders = report.histogram_borders;
  const values = [];
  for (const row of countRows(false)) {
    const bins = row.fp_distance_histogram;
    if (bins.every((n) => n === 0)) continue;
    bins.forEach((n, i) => values.push({ subject: row.subject, kind: row.kind, from: borders[i], to: borders[i + 1], count: n }));
  }
  if (values.length === 0) {
    element("distances").textContent = "There is no false positive.";
    return Promise.resolve();
  }
  const used = values.filter((v) => v.count > 0).map((v) => v.from);
  const first = borders[Math.max(0, borders.indexOf(Math.min(...used)) - 1)];
  const kinds = { vt: "vertex-triangle", ee: "edge-edge" };
  const panel = (kind) => ({
    width: 420, height: 260, title: kinds[kind],
    layer: [
      {
        transform: [{ filter: `datum.kind === "${kind}" && datum.from >= ${first}` }],
        mark: { type: "line", interpolate: "step-after", strokeWidth: 2 },
        encoding: {
          x: { field: "from", type: "quantitative", title: "distance / bound", scale: { type: "log", domain: [first, 10] },
            axis: { format: ".0e", tickCount: 8, labelAngle: -40 } },
          y: { field: "count", type: "quantitative", title: "false positives", scale: { type: "symlog" }, axis: { tickCount: 6, format: "~d" } },
          color: subjectColor,
          tooltip: [{ field: "subject" }, { field: "from", format: ".3e" }, { field: "to", format: ".3e" }, { field: "count" }],
        },
      },
      { data: { values: [{ bound: 1 }] }, mark: { type: "rule", color: color("--bad"), strokeWidth: 2 },
        encoding: { x: { field: "bound", type: "quantitative" } } },
    ],
  });
  return draw("distances", { data: { values }, hconcat: ["vt", "ee"].map(panel) });
}

function drawSweeps() {
  if (!report.sweeps) return Promise.resolve();
  element("sweeps-section").hidden = false;
  const values = [];
  for (const [family, bySubject] of Object.entries(report.sweeps))
    for (const [subject, steps] of Object.entries(bySubject))
      for (const step of steps) values.push({ family, subject, ...step, alarms: 100 * step.false_positive_rate });
  const panel = (family, field, title, y) => {
    const encoding = {
      x: { field: "value", type: "quantitative", title: `x in ${family}@x`, scale: { nice: false }, axis: { tickCount: 8 } },
      y: { field, type: "quantitative", title: null, ...y },
      tooltip: [{ field: "subject" }, { field: "value", title: "x" }, { field: "queries" }, { field: "collisions" },
        { field: "false_negatives", title: "false negatives" }, { field: "alarms", title: "false positives, %", format: ".4~g" },
        { field: "max_fp_distance_over_bound", title: "max distance / bound", format: ".4~g" },
        { field: "ns_per_query", title: "ns a query", format: ".4~g" }],
    };
    return {
      width: 270, height: 170, title: `${family}: ${title}`,
      transform: [{ filter: `datum.family === "${family}" && datum.${field} !== null` },
        ...(y.scale?.type === "log" ? [{ filter: `datum.${field} > 0` }] : [])],
      layer: [
        { mark: { type: "line", strokeWidth: 2, point: { size: 25 } }, encoding: { ...encoding, color: subjectColor } },
        { transform: [{ filter: "datum.false_negatives > 0" }], encoding,
          mark: { type: "point", shape: "cross", size: 90, angle: 45, filled: true, opacity: 1, color: color("--bad"), stroke: "#ffffff", strokeWidth: 1 } },
      ],
    };
  };
  const log = { scale: { type: "log", nice: true }, axis: { tickCount: 5, format: "~g" } };
  return draw("sweeps", {
    data: { values },
    vconcat: Object.keys(report.sweeps).map((family) => ({ hconcat: [
      panel(family, "ns_per_query", "ns a query", { ...log, axis: { tickCount: 5, format: "~s" } }),
      panel(family, "alarms", "false positives, % of all else", { axis: { tickCount: 5 } }),
      panel(family, "max_fp_distance_over_bound", "max distance / bound", { ...log, axis: { tickCount: 5, format: ".0e" } }),
    ] })),
  });
}

function drawStages() {
  const values = [];
  for (const row of countRows(false))
    for (const [truth, field] of [["true positives", "true_positives_by_stage"], ["false positives", "false_positives_by_stage"]])
      for (const [stage, n] of Object.entries(row[field])) values.push({ subject: `${row.subject} ${row.kind}`, truth, stage, count: n });
  const order = ["proximity", "ve-end", "ve-minimum", "ve-equal", "ve-zero", "vv", "unspecified"];
  return draw("stages", {
    data: { values },
    facet: { column: { field: "truth", title: null, sort: ["true positives", "false positives"] } },
    spec: {
      width: 360, height: { step: 20 },
      mark: "bar",
      encoding: {
        y: { field: "subject", type: "nominal", title: null },
        x: { field: "count", type: "quantitative", aggregate: "sum", title: "share of what was accepted", stack: "normalize", axis: { format: "%" } },
        color: { field: "stage", type: "nominal", title: "accepted by", sort: order, scale: { domain: order, range: palette } },
        order: { field: "stage", sort: "ascending" },
        tooltip: [{ field: "subject" }, { field: "truth" }, { field: "stage" }, { field: "count", aggregate: "sum" }],
      },
    },
  });
}

drawHead();
drawBaseline();
drawCounts();
element("by-family").addEventListener("change", drawCounts);
drawOracle();
drawTightness();
drawFindings();
drawFarthest();
Promise.all([drawErrorTime(), drawDistances(), drawSweeps(), drawStages()])
  .then(() => document.body.setAttribute("data-drawn", "true"))
  .catch((error) => document.body.setAttribute("data-error", String(error)));
