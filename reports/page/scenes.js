// Draws scenes: how many pairs were left out and why, and the subjects' answers for the remaining pairs.
"use strict";

const isStep = (family) => family.startsWith("scene:") && !isSimulation(family);
const sceneOf = (step) => step.replace(/^scene:/, "").replace(/#\d+$/, "");
const stepNumber = (step) => Number(step.match(/#(\d+)$/)?.[1] ?? 0);

/** Groups rows with equal values in the fields `by`, and adds up the numbers of the rows in each group. */
function summed(rows, by) {
  const sums = new Map();
  for (const row of rows) {
    const key = by.map((field) => row[field]).join("\n");
    const sum = sums.get(key);
    if (!sum) sums.set(key, { ...row });
    else
      for (const [field, value] of Object.entries(row))
        if (typeof value === "number" && !by.includes(field)) sum[field] = field === "farthest" ? Math.max(sum[field], value) : sum[field] + value;
  }
  return [...sums.values()];
}

/**
 * For each step and kind, the number of pairs with each PairFate, which says whether a pair was asked, or why
 * it was left out.
 */
const funnelRows = () => Object.entries(report.scenes ?? {}).flatMap(([step, ofKind]) =>
  Object.entries(ofKind).map(([kind, { times, ...funnel }]) =>
    ({ scene: sceneOf(step), step: stepNumber(step), kind, ...funnel, ...times })));

/** The counters of each subject in each step and kind; `time` is the run time of all queries of the row. */
const askedRows = () => countRows(true).filter((row) => isStep(row.family)).map((row) => ({
  scene: sceneOf(row.family), step: stepNumber(row.family), subject: row.subject, kind: row.kind, queries: row.queries,
  collisions: row.collisions, false_negatives: row.false_negatives, false_positives: row.false_positives,
  answered: row.queries - faults(row), farthest: row.max_fp_distance_over_bound, time: (row.ns_per_query ?? 0) * row.queries,
  ...Object.fromEntries(["planes", "no-root", "culled"].map((why) => [why, row.rejected_by[why] ?? 0])),
}));

const falsePositiveRate = (r) => (r.answered > r.collisions ? r.false_positives / (r.answered - r.collisions) : 0);

function drawScenes() {
  const all = funnelRows();
  if (all.length === 0) return;
  show("scenes-section");
  const byStep = element("by-step").checked;
  const by = byStep ? ["scene", "step", "kind"] : ["scene", "kind"];
  const steps = byStep ? [count("step", "step")] : [];
  const share = (title, field, whole) => ({ title, number: (r) => r[field], text: (r) => `${integer(r[field])} (${percent(r[whole] ? r[field] / r[whole] : 0)})` });
  fillTable(element("scenes"), [
    text("scene", "scene"), ...steps, measures.kind, count("all pairs", "all"), share("boxes apart", "boxes_apart", "all"),
    share("share a vertex", "share_vertex", "all"), share("at rest", "at_rest", "all"), share("in translation", "in_translation", "all"),
    count("static collisions", "touching"), share("asked", "asked", "all"),
    { title: "search time", number: (r) => r.finding_ns, text: (r) => duration(1e-9 * r.finding_ns) },
  ], summed(all, by), true);
  const asked = summed(askedRows(), byStep ? ["scene", "step", "subject"] : ["scene", "subject"]);
  fillTable(element("scene-subjects"), [
    text("scene", "scene"), ...steps, measures.subject, count("asked", "queries"),
    ...columnsOf("collisions", "false_negatives", "false_positives"),
    { title: "rate", number: falsePositiveRate, text: (r) => percent(falsePositiveRate(r)) },
    { title: "farthest", number: (r) => r.farthest, text: (r) => fraction(r.farthest) + markOf(r.subject) },
    { title: "ns / query", number: (r) => r.time / r.queries, text: (r) => short(r.time / r.queries) },
    { title: "total time", number: (r) => r.time, text: (r) => duration(1e-9 * r.time) },
    share("planes separate", "planes", "queries"), share("no root", "no-root", "queries"), share("VE culled", "culled", "queries"),
  ], asked, true);
}

function drawScenePictures() {
  const pictures = (report.pictures ?? []).filter(({ step }) => isStep(step.replace(/ with .*$/, "")));
  if (pictures.length > 0) element("scene-pictures").append(drawMesh(pictures));
}

/** Draws the number of pairs, the subjects' answers, and the run time along the steps. */
function drawSceneSteps() {
  const funnels = summed(funnelRows(), ["scene", "step"]);
  const rows = summed(askedRows(), ["scene", "step", "subject"]).map((r) => ({ ...r, ns_per_query: r.time / r.queries, rate: falsePositiveRate(r) }));
  const scenes = [...new Set(funnels.filter((r) => r.step > 0).map((r) => r.scene))];
  const line = (values, scene, field, title, coloured, first) => ({
    width: 190, height: 120, title: first ? { text: scene, anchor: "start" } : undefined,
    data: { values: values.filter((r) => r.scene === scene) }, mark: { type: "line", point: { size: 14 }, strokeWidth: 1.5 },
    encoding: { x: { field: "step", type: "quantitative", title: "step", axis: { tickMinStep: 1, tickCount: 5 } },
      y: { field, type: "quantitative", title, axis: { tickCount: 4, format: "~s" }, scale: { zero: true, domainMax: Math.max(1, ...values.filter((r) => r.scene === scene).map((r) => r[field])) } },
      ...(coloured ? { color: subjectColor } : { color: { value: color("--soft") } }),
      tooltip: [...(coloured ? [{ field: "subject" }] : []), { field: "step" }, { field, title, ...digits(4) }] },
  });
  return draw("scene-steps", "For each step of a scene, the pairs asked, the collisions, the false positives and the run time.", {
    vconcat: scenes.map((scene) => ({ hconcat: [
      line(funnels, scene, "asked", "pairs asked", false, true), line(rows, scene, "collisions", "collisions", false),
      line(rows, scene, "false_positives", "false positives", true), line(rows, scene, "ns_per_query", "ns a query", true),
    ] })),
  });
}

/** Draws one panel for each scene, with one mark for each subject. */
function drawSceneErrorTime() {
  const rows = summed(askedRows(), ["scene", "subject"]).map((r) => ({ ...r, ns_per_query: r.time / r.queries, rate: falsePositiveRate(r) }));
  const axis = logAxis(rows.map((r) => r.rate));
  for (const row of rows) row.shown = axis.at(row.rate);
  return draw("scene-error-time", "For each scene and subject, the run time of a query and the rate of false positives.", {
    data: { values: rows },
    facet: { field: "scene", type: "nominal", title: null }, columns: 4,
    spec: {
      width: 200, height: 150, mark: { type: "point", filled: true, size: 90, opacity: 0.9 },
      encoding: {
        x: { field: "ns_per_query", type: "quantitative", title: "ns a query", scale: { type: "log", nice: false, padding: 15 }, axis: { tickCount: 4, format: "~s" } },
        y: { field: "shown", type: "quantitative", title: "false positives", scale: axis.scale,
          axis: { ...axis.axis, labelExpr: axis.axis.labelExpr.replace("digits(datum.value, 3)", "share(datum.value)") } },
        color: subjectColor, shape: { field: "subject", type: "nominal", title: "subject", scale: { domain: subjectNames } },
        tooltip: [{ field: "scene" }, { field: "subject" }, { field: "queries", title: "asked" }, { field: "collisions" },
          { field: "false_negatives", title: "missed" }, { field: "false_positives", title: "false positives" },
          { field: "rate", ...asShare }, { field: "farthest", title: "farthest / bound", ...digits(4) },
          { field: "ns_per_query", title: "ns a query", ...digits(4) }],
      },
    },
  });
}
