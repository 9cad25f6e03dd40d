// Charts of the numbers in report.json.
"use strict";

/**
 * The width of a panel if two panels stand side by side, from 300 to `widest` pixels. `labels` is the width
 * that the labels of the two panels need together.
 */
const panelWidth = (widest, labels = 150) => Math.max(300, Math.min(widest, (element("how").clientWidth - labels) / 2));

/** Colours of algorithms: subjects that run one algorithm over different scalars have the same colour. */
const algorithmNames = [...new Set([...Object.values(report.error_against_time.subjects), ...(report.ladder?.rungs ?? [])]
  .map((row) => row.algorithm))];
const colorOfAlgorithm = (name) => palette[algorithmNames.indexOf(name) % palette.length];
const algorithmColor = (names) => ({
  field: "algorithm", type: "nominal", title: "algorithm",
  scale: { domain: names, range: names.map(colorOfAlgorithm) },
});
/** The colour halfway between two colours; all three have the form "#rrggbb". */
const mixed = (a, b) => "#" + [1, 3, 5].map((i) =>
  Math.round((parseInt(a.slice(i, i + 2), 16) + parseInt(b.slice(i, i + 2), 16)) / 2).toString(16).padStart(2, "0")).join("");
const kindTitles = { vt: "vertex-triangle", ee: "edge-edge", vv: "vertex-vertex", ve: "vertex-edge" };
const kindNames = Object.keys(kindTitles);

/** The line of a tooltip that says whose bound is the unit of distances. */
const boundField = { field: "bound_of_distances", title: "bound" };

/**
 * A logarithmic axis. If `values` has 0, the lower end of the axis stands for 0; if `values` has infinity,
 * the upper end stands for infinity. The function `at` of the result maps a value to its place on the axis.
 * `written` is the Vega expression that formats all other values.
 */
function logAxis(values, written = "digits(datum.value, 3)") {
  const exponents = values.filter((v) => v > 0 && v < Infinity).map((v) => Math.log10(v));
  const lowest = exponents.length === 0 ? 0 : Math.floor(Math.min(...exponents));
  const highest = exponents.length === 0 ? 0 : Math.max(Math.ceil(Math.max(...exponents)), lowest + 1);
  const step = Math.max(Math.ceil((highest - lowest) / 7), 1);
  // A scale cannot end at 0 or infinity.
  const power = (i) => Math.min(Math.max(10 ** i, Number.MIN_VALUE), Number.MAX_VALUE);
  const bottom = power(values.includes(0) ? lowest - step : lowest);
  const top = power(values.includes(Infinity) ? highest + step : highest);
  const ticks = [bottom, top];
  for (let i = highest; i >= lowest; i -= step) if (top === power(highest) || Math.log10(top) - i >= step / 2) ticks.push(power(i));
  const label = `datum.value < ${power(lowest - 0.5)} ? '0' : datum.value > ${power(highest + 0.5)} ? '∞' : ${written}`;
  return { at: (v) => Math.min(Math.max(v, bottom), top), scale: { type: "log", domain: [bottom, top], nice: false },
    axis: { values: ticks, labelExpr: label } };
}

const classNames = ["ordinary", "degenerate", "extreme", "unclassified"];

/**
 * Whether a row is a step of a sweep that report.json has for the row's subject; drawSweeps draws such rows.
 */
function isSweep({ subject, family }) {
  const swept = family.replace(/@[^~]*/, "");
  return swept !== family && Object.hasOwn(report.sweeps ?? {}, swept) && Object.hasOwn(report.sweeps[swept], subject);
}

/**
 * The rows with false positives. Leaves out sweeps, and queries that are not random samples (cases and
 * scenes).
 */
function rateRows() {
  return countRows(true).filter((row) => row.false_positives > 0 && row.false_positive_rate_interval_95 !== null && !isSweep(row))
    .map((row) => ({ ...row, lo: row.false_positive_rate_interval_95[0], hi: row.false_positive_rate_interval_95[1],
      median: row.median_fp_distance_over_bound[1] }));
}

function drawRates() {
  const all = rateRows();
  const rows = all.filter(isChosen);
  const names = chosenNames();
  const families = [...new Set(all.map((row) => row.family))].sort();
  const lowest = 10 ** Math.floor(Math.log10(Math.min(...all.map((row) => row.lo))));
  // The chart is at most about 2,400 pixels high, unless the names of the families need more space.
  const rowsOfSubjects = hasPicker ? names.length + 1 : 1.25 * names.length;
  const step = Math.max(11 / rowsOfSubjects, Math.min(Math.max(4, 12 / names.length), 2300 / (families.length * rowsOfSubjects)));
  const hue = chosenColor();
  const opacity = isDark ? 1 : 0.7;
  const y = { field: "family", type: "nominal", title: null, scale: { domain: families },
    ...(hasPicker ? { scale: { domain: families, padding: 0 } } : {}) };
  const yOffset = { field: "subject", scale: { domain: names, ...(hasPicker ? { padding: 1 } : {}) } };
  const decades = [];
  for (let decade = 1; decade >= 0.99 * lowest; decade /= 10) decades.push(decade);
  const rate = (field) => ({ field, type: "quantitative", title: "false positives, among non-collisions",
    scale: { type: "log", domain: [lowest, 1], nice: false }, axis: { values: decades, labelExpr: "share(datum.value)" } });
  const tooltip = [{ field: "subject" }, { field: "family" }, { field: "false_positives", title: "false positives" },
    { field: "queries" }, { field: "collisions" }, { field: "false_positive_rate", title: "rate", ...asShare },
    { field: "lo", title: "from", ...asShare }, { field: "hi", title: "to", ...asShare },
    { field: "median", title: "median distance / bound, at most", ...digits(3) },
    { field: "max_fp_distance_over_bound", title: "largest", ...digits(5) }, boundField];
  const separators = { data: { values: families.slice(1).map((family) => ({ family })) },
    mark: { type: "rule", color: color("--line") }, encoding: { y: { ...y, bandPosition: 0 } } };
  const panel = (kind, i) => ({
    width: panelWidth(400, 200), height: hasPicker ? families.length * rowsOfSubjects * step : { step, for: "offset" }, title: kindTitles[kind],
    transform: [{ filter: `datum.kind === "${kind}"` }],
    layer: [
      ...(hasPicker ? [separators] : []),
      { mark: { type: "rule", strokeWidth: 1.5 }, encoding: { y, yOffset, x: rate("lo"), x2: { field: "hi" }, color: hue, tooltip } },
      { mark: { type: "point", filled: true, size: Math.min(28, 10 * step), opacity },
        encoding: { y: i === 0 ? y : { ...y, axis: { labels: false, ticks: false } }, yOffset, x: rate("false_positive_rate"), color: hue, tooltip } },
    ],
    resolve: { axis: { y: "shared" } },
  });
  return draw("rates", "For each family and subject, the rate of false positives with its confidence interval.",
    { data: { values: rows }, hconcat: kindNames.filter((kind) => all.some((row) => row.kind === kind)).map(panel) });
}

/** The counters of each subject, kind and family with collisions, except sweeps. */
const missRows = () => countRows(true).filter((row) => row.collisions > 0 && !isSweep(row));

/** For each subject and family, the misses of all kinds together, and a text for each kind. */
function missedByFamily() {
  const cells = new Map();
  for (const row of missRows()) {
    const key = `${row.subject}\n${row.family}`;
    const cell = cells.get(key) ?? { subject: row.subject, family: row.family, class: row.class, collisions: 0, missed: 0, vt: "–", ee: "–" };
    cell.collisions += row.collisions;
    cell.missed += row.false_negatives;
    cell[row.kind] = missedText(row) + (row.false_negatives > 0 ? `, ${rateText(row.false_negative_rate, row.false_negative_rate_interval_95)}` : "");
    cells.set(key, cell);
  }
  return [...cells.values()].map((cell) => ({ ...cell, rate: cell.missed / cell.collisions }));
}

/** Draws the misses as cells: a row for each family, a column for each subject. */
function drawMisses() {
  const cells = missedByFamily();
  const failed = inOrder(report.verdicts).map(({ subject }) => subject).filter((name) => cells.some((cell) => cell.subject === name && cell.missed > 0));
  const shown = cells.filter((cell) => failed.includes(cell.subject));
  const lowest = Math.min(...shown.filter((cell) => cell.missed > 0).map((cell) => cell.rate));
  const isAny = new Set(shown.filter((cell) => cell.missed > 0).map((cell) => cell.family));
  const x = { field: "subject", type: "nominal", title: null, sort: failed, axis: { orient: "top", labelAngle: -40, labelLimit: 0 } };
  const y = { field: "family", type: "nominal", title: null, axis: { labelLimit: 0 } };
  const tooltip = [{ field: "subject" }, { field: "family" }, { field: "class" }, ...kindNames.map((kind) => ({ field: kind, title: kindTitles[kind] }))];
  const classes = classNames.filter((name) => shown.some((cell) => cell.class === name && isAny.has(cell.family)));
  const panel = (name, i) => ({
    title: { text: name, anchor: "start" }, width: { step: Math.max(24, Math.min(70, panelWidth(600) * 2 / failed.length)) }, height: { step: 15 },
    transform: [{ filter: { and: [{ field: "class", equal: name }, { field: "family", oneOf: [...isAny] }] } }],
    layer: [
      { mark: { type: "rect", color: color("--ground"), stroke: color("--line") }, encoding: { x: i === 0 ? x : { ...x, axis: null }, y, tooltip } },
      { transform: [{ filter: "datum.missed > 0" }], mark: { type: "rect", stroke: color("--line") }, encoding: { x: i === 0 ? x : { ...x, axis: null }, y, tooltip,
        color: { field: "rate", type: "quantitative", title: "missed, among collisions",
          scale: { type: "log", scheme: "reds", reverse: isDark, domain: [lowest, 1] }, legend: { orient: "bottom", format: ".1~%", gradientLength: 280, tickCount: 4 } } } },
    ],
  });
  return draw("misses", "The rate of missed collisions of each subject that missed any, family by family.",
    { data: { values: shown }, spacing: 12, vconcat: classes.map(panel) });
}

function drawDistances() {
  // The first bin begins at 0, and the last bin ends at infinity. On a logarithmic axis, these two bins are
  // drawn as wide as their neighbours.
  const borders = report.histogram_borders;
  const [width, last] = [borders[2] / borders[1], borders.length - 1];
  const begins = borders.map((border, i) => (i === 0 ? borders[1] / width : border));
  const ends = borders.map((border, i) => (i === last ? border * width : borders[i + 1]));
  const values = [];
  for (const row of countRows(false)) {
    let notFarther = 0;
    if (row.false_positives === 0) continue;
    row.fp_distance_histogram.forEach((n, i) => {
      notFarther += n;
      values.push({ subject: row.subject, kind: row.kind, bound_of_distances: row.bound_of_distances, begin: begins[i], end: ends[i], count: n, share: notFarther / row.false_positives,
        distance: i === last ? `at least ${short(borders[i])}` : `${short(borders[i])} to ${short(borders[i + 1])}` });
    });
  }
  const used = values.filter((v) => v.count > 0).map((v) => v.begin);
  const hue = chosenColor();
  const first = begins[Math.max(0, begins.findLastIndex((begin) => begin <= Math.min(0.1, ...used)) - 1)]; // left of the bound
  const label = `datum.value < ${begins[0] * 1.1} ? '0' : datum.value > ${ends[last] * 0.9} ? '∞' : digits(datum.value, 1)`;
  const decades = borders.filter((border, i) => i % 8 === 1 && border > 1.1 * first);
  const bound = { data: { values: [{ bound: 1 }] }, mark: { type: "rule", color: color("--bad"), strokeWidth: 2 },
    encoding: { x: { field: "bound", type: "quantitative" } } };
  const panel = (kind, field, title, interpolate, scale) => ({
    width: panelWidth(420, 190), height: 200, title: title === "" ? undefined : kindTitles[kind],
    layer: [
      {
        transform: [{ filter: `datum.kind === "${kind}" && datum.begin >= ${first}` }],
        mark: { type: "line", interpolate, strokeWidth: 2 },
        encoding: {
          x: { field: field === "count" ? "begin" : "end", type: "quantitative", title: "distance / bound",
            scale: { type: "log", domain: [first, ends[last]], nice: false },
            axis: { values: [first, ...decades, ends[last]], labelExpr: label, labelAngle: -40 } },
          y: { field, type: "quantitative", title, ...scale },
          color: hue,
          tooltip: [{ field: "subject" }, { field: "distance", title: "distance / bound" }, boundField, { field: "count" },
            { field: "share", title: "not farther", ...asShare }],
        },
      },
      bound,
    ],
  });
  return draw("distances", "The number of false positives at each distance, and the share of false positives up to each distance.", {
    data: { values: values.filter(isChosen) },
    columns: 2, concat: kindNames.filter((kind) => values.some((v) => v.kind === kind)).map((kind) => ({ vconcat: [
      panel(kind, "count", "false positives", "step-after", { scale: { type: "symlog" }, axis: { tickCount: 6, format: "~d" } }),
      panel(kind, "share", "not farther", "linear", { scale: { domain: [0, 1] }, axis: { tickCount: 5, format: "%" } }),
    ] })),
  });
}

function stageValues() {
  const values = [];
  for (const row of countRows(false))
    for (const [truth, field] of [["true positives", "true_positives_by_stage"], ["false positives", "false_positives_by_stage"]])
      for (const [stage, n] of Object.entries(row[field])) values.push({ subject: row.subject, row: `${row.subject} ${row.kind}`, truth, stage, count: n });
  return values;
}

/** Whether any subject reports which of its stages accepted a query. Plug-ins do not report this. */
const hasStages = () => stageValues().some(({ stage, count }) => count > 0 && stage !== "unspecified");

function drawStages() {
  const values = stageValues().filter(isChosen);
  return draw("stages", "For each subject and kind, the shares of the true and of the false positives that each test accepted.", {
    data: { values },
    facet: { column: { field: "truth", title: null, sort: ["true positives", "false positives"] } },
    spec: {
      width: panelWidth(360, 30 + 6 * Math.max(...values.map((value) => value.row.length))), height: { step: 20 },
      mark: "bar",
      encoding: {
        y: { field: "row", type: "nominal", title: null, axis: { labelLimit: 0 }, sort: chosenNames().flatMap((name) => kindNames.map((kind) => `${name} ${kind}`)) },
        x: { field: "count", type: "quantitative", aggregate: "sum", title: "share of positives", stack: "normalize", axis: { format: "%" } },
        color: { field: "stage", type: "nominal", title: "accepted by", sort: report.stages, scale: { domain: report.stages, range: palette } },
        order: { field: "stage", sort: "ascending" },
        tooltip: [{ field: "row", title: "subject" }, { field: "truth" }, { field: "stage" }, { field: "count", aggregate: "sum" }],
      },
    },
  });
}

function drawSweeps() {
  const values = [];
  for (const [family, bySubject] of Object.entries(report.sweeps))
    for (const [subject, steps] of Object.entries(bySubject))
      if (isChosen({ subject })) steps.forEach((step, i) => values.push({ row: `${family} · ${subject}`, family, subject, step: i, ...step }));
  const ends = Math.max(...values.map((v) => v.step));
  const x = { field: "step", type: "ordinal", title: null,
    axis: { values: [0, ends], labelExpr: "datum.value === 0 ? 'lowest' : 'highest'", labelAngle: 0, labelFlush: true, ticks: false } };
  const y = { field: "row", type: "nominal", title: null };
  const tooltip = [{ field: "subject" }, { field: "family" }, { field: "value", title: "parameter" }, { field: "queries" }, { field: "collisions" },
    { field: "false_negatives", title: "missed" }, { field: "false_positive_rate", title: "false positives", ...asShare },
    { field: "max_fp_distance_over_bound", title: "largest distance / bound", ...digits(4) }, boundField,
    { field: "ns_per_query", title: "ns a query", ...digits(4) }];
  const panel = (field, title, scheme, format, names) => ({
    title, width: 330, height: { step: 16 },
    layer: [
      { mark: { type: "rect", color: color("--ground") },
        encoding: { x, y: names ? y : { ...y, axis: null }, tooltip } },
      ...(values.every((v) => !(v[field] > 0 && v[field] < Infinity)) ? [] : [{ transform: [{ filter: `datum.${field} > 0 && isFinite(datum.${field})` }], mark: { type: "rect" },
        encoding: { x, y: names ? y : { ...y, axis: null }, tooltip,
          color: { field, type: "quantitative", title: null, scale: { type: "log", scheme, reverse: isDark },
            legend: { orient: "bottom", format, gradientLength: 280, tickCount: 4 } } } }]),
    ],
    resolve: { scale: { color: "independent" } },
  });
  return draw("sweeps", "Heat maps of misses, false positives, their distances and the run time along a parameter.", {
    data: { values },
    resolve: { scale: { color: "independent" } },
    vconcat: [
      { hconcat: [panel("false_negative_rate", "missed, among collisions", "reds", "~g", true),
        panel("max_fp_distance_over_bound", "largest distance / bound", "blues", "~g", false)], resolve: { scale: { color: "independent" } } },
      { hconcat: [panel("false_positive_rate", "false positives, among non-collisions", "oranges", "~g", true),
        panel("ns_per_query", "ns a query", "purples", "~s", false)], resolve: { scale: { color: "independent" } } },
    ],
  });
}
