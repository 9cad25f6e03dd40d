// Draws the ladder of precisions (one algorithm in several scalar types), and the audit of the rounding
// constants.
"use strict";

const power = (epsilon) => `2^${Math.round(Math.log2(epsilon))}`;

const partsOfClaimed = (fit) => `${fraction(fit.least_part_of_claimed)}–${fraction(fit.greatest_part_of_claimed)}`;
const exponent = (fit) => `${fit.exponent.toFixed(4)} ± ${Number(fit.half_width_95.toPrecision(2))}`;

/**
 * The text of a fit. If the farthest false positives almost reach the claimed distances, the text says only
 * that, because the fit then only restates the formula of the claim.
 */
const fitText = (fit) => `${fit.algorithm}: ` + (fit.restates_the_bound
  ? `the farthest are at ${partsOfClaimed(fit)} of the claimed distance`
  : `the farthest distance goes as ε to the power of ${exponent(fit)} (95 % confidence), at ${partsOfClaimed(fit)} of the claimed distance`) +
  ` for ${fit.points} subjects with ${fit.precisions} precisions.`;

/** Draws a table of the fitted exponents: a row for each origin of queries, columns for each algorithm. */
function drawFits(fits) {
  const origins = [...new Set(fits.map((fit) => fit.origin))];
  if (origins.length < 2) return;
  show("ladder-origins-part");
  const of = (origin, algorithm) => fits.find((fit) => fit.origin === origin && fit.algorithm === algorithm);
  fillTable(element("ladder-origins"), [{ title: "queries from", text: (origin) => origin },
    ...[...new Set(fits.map((fit) => fit.algorithm))].flatMap((algorithm) => [
      { title: `${algorithm}: exponent of ε, 95 %`, number: (origin) => of(origin, algorithm)?.exponent ?? -1,
        text: (origin) => { const fit = of(origin, algorithm); return !fit ? "–" : fit.restates_the_bound ? "the bound's" : exponent(fit); } },
      { title: "farthest / claimed", number: (origin) => of(origin, algorithm)?.greatest_part_of_claimed ?? 0,
        text: (origin) => { const fit = of(origin, algorithm); return fit ? partsOfClaimed(fit) : "–"; } },
      { title: "precisions", number: (origin) => of(origin, algorithm)?.precisions ?? 0, text: (origin) => short(of(origin, algorithm)?.precisions) }]),
  ], origins, true);
}

function drawLadder() {
  const { rungs, fits } = report.ladder;
  element("ladder-fits").textContent = fits.filter((fit) => fit.origin === "").map(fitText).join(" ") + " The paper predicts a power of ¼.";
  drawFits(fits.filter((fit) => fit.origin !== ""));
  fillTable(element("ladder"), [
    measures.subject, { title: "ε", number: (r) => r.epsilon, text: (r) => power(r.epsilon) },
    ...columnsOf("queries", "collisions", "false_negatives", "false_positives"), number("farthest / B", "farthest"), number("claimed / B", "claimed"),
    ...columnsOf("refuted_bounds", "ns_per_query"),
  ], rungs, true);
  const hue = algorithmColor([...new Set(rungs.map((r) => r.algorithm))]);
  const x = { field: "epsilon", type: "quantitative", title: "machine epsilon ε", scale: { type: "log" }, axis: { format: ".0e", tickCount: 8 } };
  const tooltip = [{ field: "subject" }, { field: "epsilon", ...digits(3) }, { field: "farthest", title: "farthest / B", ...digits(4) },
    { field: "claimed", title: "claimed / B", ...digits(4) }, { field: "false_positives", title: "false positives" },
    { field: "false_negatives", title: "missed" }, { field: "ns_per_query", title: "ns a query", ...digits(4) }];
  const distance = (field) => ({ field, type: "quantitative", title: "distance / B", scale: { type: "log" }, axis: { format: ".0e", tickCount: 8 } });
  return draw("ladder-chart", "For each machine epsilon, the farthest false positive and the distance bound.", {
    width: 640, height: 320, title: "how far false positives are: lines the bound, points the farthest found", layer: [
      { data: { values: rungs }, mark: { type: "line", strokeWidth: 1.5, strokeDash: [5, 4] }, encoding: { x, y: distance("claimed"), color: hue } },
      { data: { values: rungs.filter((r) => r.farthest > 0) }, mark: { type: "point", filled: true, size: 50 },
        encoding: { x, y: distance("farthest"), color: hue, tooltip } },
    ],
  });
}

function drawAudit() {
  if (!report.audit) return;
  const verdict = (r) => (r.too_small ? "too small" : r.needs_proof ? "not proven by Theorem 4.1" : "");
  const remark = (r) => [verdict(r), r.note].filter((part) => part).join(": ");
  show("audit-section");
  fillTable(element("audit"), [
    text("constant", "name"), text("section", "section"), text("unit", "unit"),
    { ...number("quoted", "quoted"), bad: (r) => r.too_small }, number("derived", "derived"), number("proven", "proven"),
    number("slack", "slack"), { title: "", text: remark, bad: (r) => r.too_small },
  ], report.audit.constants);
  fillTable(element("tolerances"), [
    text("scalar", "scalars"), { title: "ε", number: (r) => r.epsilon, text: (r) => `2^${r.epsilon_exponent}` },
    number("the paper's bound, B ε^¼", "paper_bound"),
    { title: "failure-proof", text: (r) => (r.paper_breaks ? `no: ${r.paper_breaks}` : "yes"), bad: (r) => r.paper_breaks !== "" },
    number("smallest bound, B ε^¼", "tight_bound"), number("in B", "tight_bound_over_B"), number("μ / B³ε", "mu"), number("τ / B²ε^½", "tau"),
    number("η / Bε^¼", "eta"), number("R / Bε^¼", "R"), number("λ² / B²ε^½", "lambda2"), number("D² / B²ε^½", "D2"), number("ψ / B²ε^½", "psi"),
  ], report.audit.tolerances);
}
