// Draws the first table: a row for each subject, the worst first.
"use strict";

/** The missed collisions of a class by kind: "vt 53 of 504, ee 0 of 701". */
const missedByKind = (subject, name) => Object.entries(report.subjects[subject]).map(([kind, { classes }]) => [kind, classes[name]])
  .filter(([, counts]) => counts?.collisions > 0)
  .map(([kind, counts]) => `${kind} ${integer(counts.false_negatives)} of ${integer(counts.collisions)}`).join(", ");

/** The text, in which powers of two, such as 2^-9, are typeset with a superscript. */
const withPowers = (text) => text.split(/(2\^-?\d+)/).flatMap((part, i) => (i % 2 === 0 ? part : ["2", made("sup", part.slice(2).replace("-", "−"))]));

/** The edge lengths and the distances from the origin at which the subject is right. */
const sizeNotes = (subject) => (report.sizes ?? []).filter((row) => row.subject === subject).flatMap(({ kind, edge, distance }) => {
  const part = (range, name) => range && range.from !== null && `${name} ${range.values}${range.wrong && ` (elsewhere ${range.wrong})`}`;
  const parts = [part(edge, "edges"), part(distance, "distance")].filter(Boolean);
  if (parts.length === 0) return [];
  const note = made("div", withPowers(`${kind === "all" ? "" : `${kind} `}right: ${parts.join("; ")}`), { class: "small wrapped" });
  note.title = "the lengths of edges, and the distances from the origin in edges, at which it misses nothing and reports little more than at best";
  return [note];
});

/**
 * The cell about misses. If there are misses, it shows those of the least exotic class for each kind, then
 * the rates of the other classes, then the sum. Otherwise it shows the sum, then the rates of all classes.
 */
const missedCell = ({ counts, classes, subject, failures }) => {
  if (failures.includes("unjudged") && counts.collisions === 0) return [made("strong", "not judged", { class: "bad" })];
  if (counts.collisions === 0) return ["no collision"];
  const [first, ...others] = Object.entries(classes).filter(([, each]) => each.collisions > 0);
  const rateOf = ([name, each]) => `${name} ${each.false_negatives === 0 ? "0" : percent(each.false_negative_rate)}`;
  if (counts.false_negatives === 0) return [missedText(counts), small([first, ...others].map(rateOf).join(" · ")), ...sizeNotes(subject)];
  const [name, { false_negatives: missed }] = first;
  const text = `${name === "unclassified" ? "" : `${name} `}${missedByKind(subject, name)}`;
  return [missed > 0 ? made("strong", text, { class: "bad" }) : text,
    small([...others.map(rateOf), `in all ${missedText(counts)}`].join(" · ")), ...sizeNotes(subject)];
};

const falseCell = ({ counts, subject }) => {
  const unknown = counts.unknown > 0 ? [small(`unknown in ${integer(counts.unknown)} queries`)] : [];
  if (counts.false_positives === 0) return ["none", ...unknown];
  const beyond = counts.refuted_bounds > 0 ? [", ", made("strong", `${integer(counts.refuted_bounds)} beyond its bound`, { class: "bad" })] : [];
  const far = farthestOfSubject(subject);
  const farthest = `farthest ${timesTheBound(counts.max_fp_distance_over_bound, counts)}`;
  return [`${integer(counts.false_positives)}, ${percent(counts.false_positive_rate)}`, ...beyond,
    small(far ? made("a", farthest, { href: far.file }) : farthest), ...unknown];
};

/**
 * The number of queries without an answer, with the reasons as a tooltip. Slow queries, and queries that a
 * contract excludes, do not count as failures.
 */
function noAnswerCell(verdict) {
  const reasons = [...new Set(Object.keys(verdict.faults).map((why) => (["time", "not-asked"].includes(why) ? "slow" : why)))];
  if (reasons.length === 0) return "0";
  const isFailure = verdict.failures.includes("fault");
  return [made(isFailure ? "strong" : "span", integer(faults(verdict)), { title: faultText(verdict), ...(isFailure ? { class: "bad" } : {}) }),
    small(reasons.length === 1 ? reasons[0] : `${reasons[0]}, …`)];
}

/**
 * The logarithmic scale of the bars, from half of the shortest time to the longest time.
 */
const barScale = (() => {
  const times = report.verdicts.flatMap((v) => [v.times.median_ns, v.times.q99_ns, v.counts.ns_per_query]).filter((ns) => ns > 0);
  const [least, most] = [Math.min(...times) / 2, Math.max(...times)];
  return (ns) => `${(100 * Math.log(ns / least)) / Math.log(most / least)}%`;
})();

/**
 * The median time of the queries that were timed one by one; if there are none, the time per query of
 * batches.
 */
const usualTime = ({ counts, times }) => times.median_ns ?? counts.ns_per_query;

/** The usual time of a query, and the 99 % quantile of the queries that were timed one by one. */
const timeCell = (verdict) => {
  const { median_ns: median, q99_ns: q99 } = verdict.times;
  const usual = usualTime(verdict);
  if (!(usual > 0)) return ["–"];
  const part = (name, ns) => made("span", [], { class: name, style: `width: ${barScale(ns)}` });
  return [median === null ? short(usual) : `${short(median)}, 99 % ${short(q99)}`,
    made("div", [...(q99 > 0 ? [part("q99", q99)] : []), part("median", usual)], { class: "bar", "aria-hidden": "true" })];
};

const changeCell = ({ since, clean }) => {
  const parts = [
    ...(since.new > 0 ? [made("strong", counted(since.new, "new way to fail", "new ways to fail"), { class: "bad" })] : []),
    ...(since.worse > 0 ? [made("strong", counted(since.worse, "rate worse", "rates worse"), { class: "bad" })] : []),
    ...(since.slower > 0 ? [made("strong", counted(since.slower, "run time slower", "run times slower"), { class: "bad" })] : []),
    ...(since.absent ? ["not in the baseline"] : []),
  ];
  const rest = [since.lasting > 0 && `${counted(since.lasting, "way", "ways")} as before`, since.gone > 0 && `${counted(since.gone, "way", "ways")} gone`,
    since.better > 0 && counted(since.better, "rate better", "rates better"), since.faster > 0 && counted(since.faster, "run time faster", "run times faster")]
    .filter(Boolean).join(", ");
  const lines = parts.map((each) => made("div", each));
  if (lines.length === 0) lines.push(made("div", clean ? "nothing new" : "nothing worse"));
  return [...lines, ...(rest ? [small(rest)] : [])];
};

const againCell = ({ finding, clean }) => {
  if (finding === null) return [clean ? "" : "none kept"];
  const again = replayCommand(report.findings[finding]);
  const button = copyButton(again, "copy");
  button.title = again;
  return [button, " ", findingLink("show", finding)];
};

/** Whether the subject failed. On queries beyond its contract, a subject cannot fail. */
const markCell = ({ clean, beyond_contract: isBeyond }) => made("span", isBeyond ? "–" : clean ? "ok" : "FAIL",
  { class: "mark", ...(isBeyond ? { title: "does not count: the contract excludes these queries" } : {}) });

/** The subject's name, which links to its findings, or to its counts if it has no findings. */
function subjectCell({ subject, finding }) {
  const link = made("a", subject, { href: finding === null ? "#counts-section" : "#findings-section", title: subject });
  if (finding !== null) link.addEventListener("click", () => filterFindings({ subject }));
  return link;
}

/**
 * Sorts subjects. Failed subjects come first, sorted by their rates of misses on ordinary queries, then on
 * the other classes. Subjects without failures follow, sorted by their run times. Subjects that are asked
 * beyond their contracts are last.
 */
function inOrder(verdicts) {
  const rates = ({ classes }) => classNames.map((name) => -(classes[name]?.false_negative_rate ?? 0));
  const key = (verdict) => [verdict.beyond_contract ? 2 : verdict.clean ? 1 : 0, ...rates(verdict), -verdict.counts.late, verdict.clean ? usualTime(verdict) ?? Infinity : 0];
  return [...verdicts].sort((a, b) => {
    const [x, y] = [key(a), key(b)];
    const i = x.findIndex((each, k) => each !== y[k]);
    return i < 0 ? 0 : x[i] - y[i];
  });
}

const isGood = ({ clean, beyond_contract: isBeyond }) => clean && !isBeyond;

/**
 * The rows of clean subjects that are folded into one row. The folded subjects are the clean subjects on the
 * precision ladder (one algorithm in several scalar types). If too many other clean subjects would remain,
 * all clean subjects are folded. Nothing is folded if there are few clean subjects.
 */
function foldedRows(rows) {
  const good = rows.filter(isGood);
  if (good.length <= fewSubjects) return [];
  const folded = good.filter(isNoRung).length <= fewSubjects ? good.filter((row) => !isNoRung(row)) : good;
  return folded.length > 1 ? folded : [];
}

function drawScorecard() {
  const rows = inOrder(report.verdicts);
  element("verdicts").toggleAttribute("hidden", rows.length === 0 && !report.oracle.complaint);
  const hasTimes = rows.some(({ counts }) => counts.times_promised > 0);
  const columns = [
    ["", markCell],
    ["subject", subjectCell],
    ["missed collisions", missedCell],
    ...(hasTimes ? [["late times", ({ counts }) => (counts.times_promised === 0 ? "–"
      : [made(counts.late > 0 ? "strong" : "span", `${integer(counts.late)} of ${integer(counts.times_promised)}`, counts.late > 0 ? { class: "bad" } : {}),
        ...(counts.committed > 0 ? [small(`${integer(counts.committed)} rounded steps touch`)] : [])])]] : []),
    ["false positives", falseCell, "wraps"],
    ...(rows.some(({ faults }) => Object.keys(faults).length > 0) ? [["no answer", noAnswerCell]] : []),
    ["ns a query, median", timeCell],
    ...(report.baseline ? [["since the baseline", changeCell]] : []),
    ...(report.findings.length > 0 ? [["simplest failure", againCell]] : []),
  ];
  const line = (verdict) => made("tr", columns.map(([title, content, name = ""]) => made("td", content(verdict), { "data-title": title, class: name })), { class: `verdict${verdict.beyond_contract ? " beyond" : verdict.clean ? "" : " bad"}` });
  const table = element("scorecard");
  table.createTHead().insertRow().append(...columns.map(([title]) => made("th", title || made("span", "verdict", { class: "unseen" }), { scope: "col" })));
  const wide = (content, attributes) => made("tr", made("td", content, { colspan: columns.length }), attributes);
  const body = made("tbody");
  if (report.oracle.complaint) body.append(wide([made("span", "FAIL", { class: "mark" }), ` oracle: ${report.oracle.complaint}`], { class: "verdict bad" }));
  const folded = foldedRows(rows);
  body.append(...rows.filter((row) => !folded.includes(row)).map(line));
  table.append(body);
  if (folded.length === 0) return;
  const rest = made("tbody", folded.map(line), { hidden: "", id: "clean-subjects" });
  const others = folded.length < rows.filter(isGood).length ? "others" : "subjects";
  const toggle = made("button", `${folded.length} ${others} did not fail`, { type: "button", "aria-expanded": "false", "aria-controls": "clean-subjects" });
  toggle.addEventListener("click", () => toggle.setAttribute("aria-expanded", String(!rest.toggleAttribute("hidden"))));
  body.append(wide([made("span", "ok", { class: "mark" }), " ", toggle], { class: "verdict" }));
  table.append(rest);
}

/**
 * Draws a table with the pairs of versions of a CCD, which shows on how many queries each version fails.
 * Below the table, links to the simplest query that the later version breaks.
 */
function drawVersions() {
  if (!report.versions) return;
  show("versions-section");
  fillTable(element("versions"), [text("version", "after"), text("against", "before"), ...columnsOf("class", "kind"),
    count("fixed", "fixed"), count("broken", "broken", true), count("both fail", "both"), count("neither fails", "neither"), measures.queries],
  report.versions);
  const pairs = new Map(report.versions.map(({ before, after }) => [`${after} ${before}`, { before, after }]));
  for (const { before, after } of pairs.values()) {
    const isCompared = (kind) => report.versions.some((row) => row.before === before && row.after === after && row.kind === kind);
    for (const kind of kindNames.filter((each) => !isCompared(each) && Boolean(report.subjects[before][each]) !== Boolean(report.subjects[after][each])))
      element("broken").append(made("li", `${after} against ${before}: ${kind} is not compared, because one of them was not asked about it`));
    const index = report.findings.findIndex((each) => each.subject === after && each.broken_since === before);
    if (index < 0) continue;
    element("broken").append(made("li", [`${after} against ${before}: the `, findingLink("simplest query that it breaks", index), command(replayCommand(report.findings[index]))]));
  }
}
