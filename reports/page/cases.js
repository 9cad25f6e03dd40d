// Draws single queries: findings, the farthest false positives, and the earliest and latest times.
"use strict";

/** Shows the failure, the number of times that it was seen, and the origin of its query. */
function drawFailure(finding) {
  const what = `${finding.what} of ${finding.subject || "the oracle"}` +
    (finding.late_by ? `, by ${short(finding.late_by)} of the step` : finding.ratio ? `, ${timesTheBound(finding.ratio, finding)}` : "");
  return made("div", [
    ...(finding.new ? [made("div", "NEW since the baseline", { class: "bad" })] : []),
    made("strong", what), made("div", finding.signature), made("div", finding.seen === 1 ? "seen once" : `seen ${integer(finding.seen)} times`, { class: "seen" }),
    made("div", `from ${finding.provenance}`), made("div", `the simplest query: ${finding.explanation}`),
  ]);
}

/** Shows the command that replays the finding, the shrunk query, and a fold-out with the original query. */
function drawShrunk(finding) {
  const original = made("details", [made("summary", finding.original_file), queryText(finding.original), copyQuery(finding.original)]);
  return made("div", [command(finding.again), queryText(finding.shrunk), copyQuery(finding.shrunk), original]);
}

const picture = (query, title = "t = 0, t* or closest, t = 1") => ({
  title, text: (r) => drawPicture(r.kind, r[query], r.time, r.toi),
});

function drawFindings() {
  show("findings-section");
  const seen = report.signatures.reduce((sum, each) => sum + each.seen, 0);
  element("findings-note").textContent = seen === 0
    ? "None: no false negative, no late time, no bound refuted, no disagreement."
    : `${integer(seen)} failures in ${integer(report.signatures.length)} ways. The first few of each way are kept and shrunk to the ` +
      "simplest query that fails in the same way. findings.csv lists them, and cases/ has a case file for each shrunk query and for " +
      "each original query. The commands work in this report's folder; copied queries are lines for nearmiss oracle and verdict. " +
      "Pictures show both primitives at t*, when they first touch or come within the separation h, or when they are closest if they never " +
      "do. They are pale at t = 0, and pale and dashed at t = 1. If a time is late, they are also shown at that time, toi. Mouse and arrow " +
      "keys turn the pictures.";
  if (seen === 0) return;
  for (const each of report.common_factors ?? [])
    element("common-factors").append(made("li", `${each.subject} ${each.kind}, ${each.family}: ${each.text}.`));
  const newFirst = [...report.findings].sort((a, b) => Number(b.new) - Number(a.new));
  fillTable(element("findings"), [
    picture("shrunk"),
    { title: "what", text: drawFailure }, { title: "the simplest query that fails in the same way", text: drawShrunk },
  ], newFirst);
}

function drawFarthest() {
  const rows = countRows(false).map(farthestOf).filter(Boolean);
  if (rows.length === 0) return;
  show("farthest-section");
  fillTable(element("farthest"), [
    picture("query"),
    { title: "subject", text: (r) => made("div", [made("strong", `${r.subject} ${r.kind}`), made("div", timesTheBound(r.ratio, r)), made("div", `from ${r.provenance}`)]) },
    { title: "query", text: (r) => made("div", [made("a", r.file, { href: r.file }), queryText(r.query), copyQuery(r.query)]) },
  ], rows);
}

function drawExtremeTimes() {
  const rows = report.extreme_times;
  if (rows.length === 0) return;
  show("extreme-times-section");
  // If the distance only touches h, a time after t* is not late. Where both occur, nobody says which this one is.
  const isLate = ({ subject, kind, side }) => {
    const { late, after_histogram: after } = report.subjects[subject][kind];
    return side === "after" && late === after.reduce((a, b) => a + b, 0);
  };
  const what = (r) => (isLate(r) ? "late" : r.side === "early" ? "early" : "after t*");
  fillTable(element("extreme-times"), [
    picture("query", "t = 0, toi and t*, t = 1"),
    { title: "subject", text: (r) => made("div", [made("strong", `${r.subject} ${r.kind}`, isLate(r) ? { class: "bad" } : {}),
      made("div", `${what(r)} by ${short(r.error)} of the step`), made("div", `from ${r.provenance}`)]) },
    { title: "query", text: (r) => made("div", [queryText(r.query), copyQuery(r.query)]) },
  ], rows);
}
