// Draws the report. All numbers come from report.json; the page only adds and divides them.
"use strict";

// --- head -----------------------------------------------------------------------------------------

function drawHead() {
  const { clean, text: headline } = report.headline;
  element("headline").textContent = headline;
  element("headline").classList.toggle("bad", !clean);
  document.title = `${clean ? "ok" : "FAIL"}: nearmiss report`;
  element("runs").textContent = report.runs
    .map((run) => [run.command, run.seed && `seed ${run.seed}`, run.separation && `separation ${run.separation}`, run.started, run.seconds >= 1 && duration(run.seconds),
      run.missing && `INCOMPLETE: ${run.missing}`].filter(Boolean).join(", "))
    .join(" · ");
}

function drawNavigation() {
  const titles = { "findings-section": `Findings (${report.findings.length})` };
  for (const section of document.querySelectorAll("main section:not([hidden]) > h2"))
    document.querySelector("nav").append(made("a", titles[section.parentNode.id] ?? section.textContent, { href: `#${section.parentNode.id}` }));
}

/** Lists the run times that have changed since the baseline by more than chance explains. */
function drawChangedTimes({ changed_times: times, compared_times: compared, campaigns_with_times: campaigns }) {
  const say = (content, bad) => element("news").append(made("li", content, bad ? { class: "bad" } : {}));
  if (campaigns === 0) return say("Run times are not compared: the baseline ran on another model of processor.");
  const slower = times.filter((each) => each.slower).length;
  say(times.length === 0 ? `None of ${integer(compared)} run times differs by more than those of equal campaigns do.`
    : `${slower} of ${integer(compared)} run times are slower and ${times.length - slower} faster than in equal campaigns.`, slower > 0);
  if (times.length === 0) return undefined;
  const ns = (title, field) => ({ title, number: (r) => r[field], text: (r) => short(r[field]) });
  return fillTable(element("changed-times"), [
    { title: "run time", text: (r) => (r.slower ? "slower" : "faster"), bad: (r) => r.slower },
    ...columnsOf("subject", "kind", "family"), ns("ns before", "before_ns"), ns("ns expected", "expected_ns"), ns("ns now", "now_ns"), ns("now / expected", "ratio"),
    { title: "p", number: (r) => r.p, text: (r) => r.p.toExponential(1) },
  ], times);
}

function drawBaseline() {
  const baseline = report.baseline;
  if (!baseline) return;
  show("baseline");
  const sighting = (date, code) => (code ? `${date} by ${code}` : date);
  const way = (each) => `${each.what}, ${each.signature}` +
    (each.first_seen ? ` (first seen ${sighting(each.first_seen, each.first_code)}, last seen ${sighting(each.last_seen, each.last_code)})` : "") +
    (each.fixed ? `, fixed ${each.fixed}` : "");
  const groups = [
    ["new_signatures", "new way to fail", "new ways to fail", true], ["lasting_signatures", "way to fail as before", "ways to fail as before", true],
    ["unseen_signatures", "not in the baseline, as chance explains", "not in the baseline, as chance explains", false],
    ["gone_signatures", "way to fail gone", "ways to fail gone", false], ["unrepeated_signatures", "not seen again, as chance explains", "not seen again, as chance explains", false],
  ];
  const say = (content, bad) => element("news").append(made("li", content, bad ? { class: "bad" } : {}));
  const subjects = new Set(groups.flatMap(([field]) => baseline[field].map((each) => each.subject)));
  for (const subject of subjects) {
    const some = groups.map(([field, one, many, bad]) => ({ list: baseline[field].filter((each) => each.subject === subject), one, many, bad }))
      .filter(({ list }) => list.length > 0);
    const summary = made("summary", [made("strong", subject || "the oracle"), ": ", ...some.flatMap(({ list, one, many, bad }, i) =>
      [i > 0 ? ", " : "", made("span", counted(list.length, one, many), bad && one.startsWith("new") ? { class: "bad" } : {})])]);
    say(made("details", [summary, ...some.map(({ list, many }) => made("div", [made("h3", many), made("ul", list.map((each) => made("li", way(each))))]))]));
  }
  if (baseline.absent_subjects.length > 0) say(`Not in the baseline: ${baseline.absent_subjects.join(", ")}.`);
  if (baseline.new_signatures.length === 0) say("No new way to fail.");
  if (baseline.unseen_signatures.length > 0) say(`By chance, about ${short(Math.round(baseline.expected_unseen))} ways that are not in the baseline were expected.`);
  const worse = baseline.changed_rates.filter((each) => each.worse).length;
  say(baseline.changed_rates.length === 0
    ? `None of ${integer(baseline.compared_rates)} rates differs by more than chance explains (exact tests, ` +
      `level ${baseline.level} for all together).`
    : `${worse} of ${integer(baseline.compared_rates)} rates are worse and ${baseline.changed_rates.length - worse} better than chance ` +
      `explains (exact tests, level ${baseline.level} for all together).`, worse > 0);
  const rate = (title, when) => ({ title, number: (r) => r[when].rate,
    text: (r) => `${percent(r[when].rate)} (${percentRange(r[when].interval_95)}), ${integer(r[when].count)} of ${integer(r[when].total)}` });
  if (baseline.changed_rates.length > 0)
    fillTable(element("changed-rates"), [
      { title: "rate", text: (r) => r.what, bad: (r) => r.worse },
      ...columnsOf("subject", "kind", "family"), rate("before", "before"), rate("now", "now"),
      { title: "p", number: (r) => r.p, text: (r) => r.p.toExponential(1) },
    ], baseline.changed_rates);
  drawChangedTimes(baseline);
  const pair = (title, field, form = short) => ({ title, number: (r) => r.now[field],
    text: (r) => `${form(r.before[field], r.before)} → ${form(r.now[field], r.now)}` });
  const marked = (x, counts) => fraction(x) + unitMark(counts);
  fillTable(element("before-and-now"), [
    ...columnsOf("subject", "kind"), pair("queries", "queries"), pair("false negatives", "false_negatives"),
    pair("false positives", "false_positive_rate", percent), pair("largest distance / bound", "max_fp_distance_over_bound", marked),
    pair("ns / query", "ns_per_query"),
  ], baseline.subjects.filter(({ before }) => before));
  if (baseline.changed_facts.length > 0)
    element("changed-facts").textContent = "The runs differ in: " +
      baseline.changed_facts.map((fact) => `${fact.name} (${fact.before || "none"} → ${fact.now || "none"})`).join("; ") +
      ". Therefore rates are compared, not counts.";
}

// --- units of distances ---------------------------------------------------------------------------

/** Says which subjects claim no bound, next to everything that shows distances of false positives. */
function drawUnits() {
  const names = [...new Set(countRows(false).filter((row) => !isOfClaim(row)).map((row) => row.subject))];
  if (names.length === 0) return;
  const who = names.length > fewSubjects ? `${names.length} subjects claim` : `${names.join(", ")} ${names.length === 1 ? "claims" : "claim"}`;
  for (const note of document.querySelectorAll(".units")) {
    note.textContent = `** ${who} no bound. These distances are in units of wang's bound for the same pair; they are no fractions of a claim, ` +
      "and a ratio above 1 refutes nothing.";
    note.removeAttribute("hidden");
  }
}

// --- counts ---------------------------------------------------------------------------------------

const faults = (r) => Object.values(r.faults).reduce((a, b) => a + b, 0);
/** "3 crash, 1 time" */
const faultText = (r) => Object.entries(r.faults).map(([why, times]) => `${integer(times)} ${why}`).join(", ");
const noAnswer = {
  title: "no answer", number: faults, bad: (r) => faults(r) > 0,
  text: (r) => faultText(r) || "0",
};
const timing = (title, field) => ({ title, number: (r) => r.times[field] ?? -1, text: (r) => short(r.times[field]) });

/** The farthest of the false positives in a list; undefined if the list is empty. */
const farthestAmong = (some) => some.reduce((a, b) => (a && a.ratio >= b.ratio ? a : b), undefined);
const farthestOfSubject = (subject) => farthestAmong(report.farthest.filter((far) => far.subject === subject));
/** The farthest false positive of a subject and kind, in one family, in one class or in all families. */
const farthestOf = ({ subject, kind, family, class: own }) => farthestAmong(report.farthest
  .filter((far) => far.subject === subject && far.kind === kind && (family === "" || far.shown_family === family) &&
    (own === undefined || far.class === own)));

function drawCounts() {
  const [byClass, byFamily] = ["by-class", "by-family"].map((id) => element(id).checked);
  const rows = byClass && !byFamily ? classRows() : countRows(byFamily);
  if (rows.length === 0) return;
  show("counts-section");
  const largest = { ...number("largest dist.", "max_fp_distance_over_bound"), text: (r) => fraction(r.max_fp_distance_over_bound) + unitMark(r) };
  const columns = [
    ...columnsOf("subject", "kind", ...(byClass ? ["class"] : []), ...(byFamily ? ["family"] : []), "queries", "collisions", "false_negatives"),
    { title: "rate of misses below", number: (r) => r.false_negative_rate_upper_95 ?? -1,
      text: (r) => (r.false_negative_rate_upper_95 === null ? "–" : percent(r.false_negative_rate_upper_95)) },
    measures.false_positives,
    { title: "rate (95 %)", number: (r) => r.false_positive_rate,
      text: (r) => percent(r.false_positive_rate) +
        (r.false_positive_rate_interval_95 === null ? "" : ` (${percentRange(r.false_positive_rate_interval_95)})`) },
    ...columnsOf("median_fp_distance_over_bound", "q99_fp_distance_over_bound"),
    { ...largest, text: (r) => { const far = farthestOf(r); return far ? made("a", largest.text(r), { href: far.file }) : "–"; } },
    measures.refuted_bounds, ...(rows.some((r) => r.times_promised > 0) ? [lateTimes] : []),
    ...(rows.some(faults) ? [noAnswer] : []), measures.ns_per_query, timing("mean ns", "mean_ns"), timing("median below", "median_ns"), timing("99 % below", "q99_ns"),
    { title: "timed singly", number: (r) => r.times.sampled, text: (r) => integer(r.times.sampled) },
  ];
  fillTable(element("counts"), columns, rows, true);
}

function drawSlowest() {
  const most = 5;
  const onTrial = report.verdicts.some(isNoRung) ? report.verdicts.filter(isNoRung) : report.verdicts;
  const rows = onTrial.flatMap(({ subject }) =>
    Object.entries(report.subjects[subject]).flatMap(([kind, { times }]) => (times.slowest ?? []).map((slow) => ({ subject, kind, ...slow })))
      .sort((a, b) => b.ns - a.ns).slice(0, most));
  if (rows.length === 0) return;
  show("slowest-section");
  fillTable(element("slowest"), [
    ...columnsOf("subject", "kind"), count("ns", "ns"), text("from", "provenance"),
    { title: "query", text: (r) => copyButton(r.query) },
  ], rows, true);
}

/**
 * Draws a table for subjects that pass a query on to another stage if they are not sure. The table shows how
 * many queries each stage decided.
 */
function drawDeciders() {
  const rows = report.deciders;
  if (!rows) return;
  show("stages-section");
  show("deciders-part");
  const share = (title, name) => ({ title, number: (r) => r.decided_by[name] / r.queries,
    text: (r) => `${percent(r.decided_by[name] / r.queries)} (${integer(r.decided_by[name])})` });
  const over = (name) => (rows.some((r) => r.time_over[name])
    ? [{ title: `/ ${name}`, number: (r) => r.time_over[name] ?? -1, text: (r) => short(r.time_over[name]) }] : []);
  fillTable(element("deciders"), [
    measures.subject, { title: "family", text: (r) => r.family || "all" }, measures.queries,
    share("its algorithm", "algorithm"), share("certified filter", "filter"), share("finer scalar", "finer"),
    share("exact arithmetic", "exact"), measures.ns_per_query, ...over("wang"), ...over("exact"),
  ], rows, true);
}

function drawOracle() {
  const byFamily = element("oracle-by-family").checked;
  const rows = [];
  for (const [kind, families] of Object.entries(report.oracle.families ?? {}))
    for (const [family, each] of Object.entries(families)) {
      const row = { kind, family, ...each.decided_by, ...each };
      const sum = rows.find((other) => !byFamily && other.kind === kind);
      if (!sum) rows.push(row);
      else for (const [field, value] of Object.entries(row)) if (typeof value === "number") sum[field] += value;
    }
  if (rows.length === 0) return;
  show("oracle-section");
  const stages = Object.keys(report.oracle.total.decided_by);
  const nearBounds = rows.some((row) => row.near_bounds > 0) ? [count("near bounds", "near_bounds")] : [];
  fillTable(element("oracle"), [
    ...columnsOf("kind", ...(byFamily ? ["family"] : []), "queries", "collisions"),
    ...stages.map((stage) => count(stage, stage)), ...nearBounds, count("by all methods", "compared"),
    count("collisions among them", "compared_collisions"), count("with even roots", "missed_by_parity"),
  ], rows);
}

// --- power of detection ---------------------------------------------------------------------------

function drawPower() {
  if (!report.power) return;
  show("power-section");
  const ways = [...new Set(report.power.map((hunt) => hunt.way))];
  const rows = [...new Set(report.power.map((hunt) => hunt.subject))].map((subject) =>
    ({ subject, ...Object.fromEntries(report.power.filter((hunt) => hunt.subject === subject).map((hunt) => [hunt.way, hunt])) }));
  const cell = (hunt) => !hunt ? "" : !hunt.failure ? "–"
    : `${short(hunt.seconds)} s, ${integer(hunt.cases)}${{ "refuted-bound": " *", late: " +" }[hunt.failure] ?? ""}`;
  const found = (way) => rows.filter((row) => row[way]?.failure).length;
  fillTable(element("power"), [
    text(`defect (${rows.length})`, "subject"),
    ...ways.map((way) => ({ title: `${way} (${found(way)})`, text: (r) => cell(r[way]), number: (r) => r[way]?.seconds ?? Infinity })),
  ], rows, true);
}

function drawPaper() {
  if (!report.paper) return;
  show("paper-section");
  fillTable(element("paper"), [
    text("claim", "name"), text("section", "section"), text("the paper says", "says"),
    { ...text("verdict", "verdict"), bad: (r) => r.verdict === "does not hold" },
    text("we measure", "measured"), { title: "commands", text: (r) => r.commands.join("; ") },
  ], report.paper.claims);
}

function drawFeatureDistances() {
  if (!report.distances) return;
  show("feature-distances-section");
  const { counts, right, findings } = report.distances;
  fillTable(element("feature-distances"), [
    text("subject", "subject"), text("kind", "kind"), count("distances", "queries"),
    count("over-reported", "over_reported", true), count("ordinary", "ordinary", true), number("largest / size", "largest_over"),
    count("under-reported", "under_reported"), number("largest / size", "largest_under"),
    count("wrong weights", "wrong_weights", true), count("no answer", "faults", true),
  ], counts, true);
  const ranges = right.filter((r) => r.from !== null && r.unsafe_elsewhere > 0);
  fillTable(element("feature-ranges"), [
    text("subject", "subject"), text("kind", "kind"), text("factor", "factor"),
    { title: "right from", text: (r) => `2^${r.from} to 2^${r.to}` },
    count("over-reported elsewhere", "unsafe_elsewhere", true), count("of", "answers_elsewhere"),
  ], ranges);
  if (ranges.length > 0) show("feature-ranges-part");
  fillTable(element("feature-findings"), [
    text("subject", "subject"), text("closest", "signature"), text("class", "class"), text("failure", "text"),
    text("vertices", "places"),
  ], findings);
  if (findings.length > 0) show("feature-findings-part");
}

function drawEnvironments() {
  if (!report.environments) return;
  show("environments-section");
  fillTable(element("environments"), [
    text("CCD", "subject"), text("compiler", "compiler"), text("flags", "flags"), text("mode", "mode"),
    ...columnsOf("queries", "collisions"), count("missed", "missed", true), ...columnsOf("false_positives", "refuted_bounds"),
    count("no answer", "faults", true),
    { ...text("guarantee", "verdict"), bad: (r) => r.missed + r.faults > 0 },
    { title: "first failure", text: (r) => r.first ?? "" },
  ], report.environments, true);
}

function drawTightness() {
  const rows = Object.entries(report.tightness ?? {}).map(([name, extreme]) => ({ name, ...extreme }));
  if (rows.length === 0) return;
  show("tightness-section");
  const meanings = { "accepting-tolerance": "missed with this factor or less", "keeping-tolerance": "missed with this factor or more",
    distance: "distance / bound" };
  fillTable(element("tightness"), [
    text("tolerance or tests", "name"), { title: "value", text: (r) => meanings[r.of] },
    { title: "value", number: (r) => r.value ?? 0, text: (r) => (r.value === null ? "none found" : short(r.value)) },
    measures.queries, { title: "from", text: (r) => r.provenance ?? "" },
  ], rows);
}

// --- how ------------------------------------------------------------------------------------------

function drawHow() {
  for (const run of report.runs) {
    const { again, environments, seconds, cases_done, ...facts } = run;
    const lines = [...Object.entries(facts), ["cases decided", integer(cases_done)], ["run time of all shards", duration(seconds)],
      ...environments.flatMap((each) => Object.entries(each))].map(([name, value]) =>
      made("tr", [made("th", name, { scope: "row" }), made("td", value)]));
    if (again) lines.unshift(made("tr", [made("th", "command to repeat", { scope: "row" }), made("td", command(again))]));
    element("how").append(made("div", made("table", made("tbody", lines)), { class: "scroll" }));
  }
}

/** Draws a part of the page. If that fails, the page says so, and the other parts are still drawn. */
function drawPart(draw) {
  try {
    draw();
  } catch (error) {
    document.body.setAttribute("data-error", String(error));
    element("headline").after(made("p", `A part of this page cannot be drawn (${draw.name}): ${error.message}`, { class: "bad" }));
  }
}
for (const draw of [drawHead, drawScorecard, drawExample, drawFindings, drawVersions, drawBaseline, drawUnits, drawCounts, drawScenes, drawScenePictures, drawSimulations, drawTimes, drawSlowest,
  drawDeciders, drawOracle, drawPaper, drawFeatureDistances, drawAudit, drawPower, drawEnvironments, drawTightness, drawFarthest, drawExtremeTimes, drawHow])
  drawPart(draw);
for (const id of ["by-class", "by-family"]) element(id).addEventListener("change", drawCounts);
element("by-step").addEventListener("change", drawScenes);
element("times-by-family").addEventListener("change", drawTimes);
element("oracle-by-family").addEventListener("change", drawOracle);
if (ownFolder !== "")
  for (const each of document.querySelectorAll(".commands-note"))
    each.textContent = `The commands work in any folder, on a machine that has this report in ${ownFolder}`;

// For one or two subjects, a chart of error against run time says no more than the tables.
const charts = [
  ["error-time-section", drawErrorTime, Object.keys(report.error_against_time.subjects).length > 2],
  ["misses-time-part", drawMissesTime, report.error_against_time.ladder === undefined && ordinaryRows().some((row) => row.missed > 0) && ordinaryRows().length > 2],
  ["earliness", drawEarliness, earlinessRows().length > 2],
  ["options-section", drawOptions, report.option_sweeps !== undefined],
  ["misses-section", drawMisses, missRows().some((row) => row.false_negatives > 0)],
  ["rates-section", drawRates, rateRows().length > 0],
  ["distances-section", drawDistances, countRows(false).some((row) => row.false_positives > 0)],
  ["time-errors-section", drawTimeErrors, timedRows().length > 0],
  ["stages-section", drawStages, hasStages()],
  ["ladder-section", drawLadder, report.ladder !== undefined],
  ["sweeps-section", drawSweeps, report.sweeps !== undefined],
  ["simulated-steps", drawSimulatedSteps, report.simulations !== undefined],
  ["scene-steps", drawSceneSteps, funnelRows().some((row) => row.step > 0)],
  ["scene-error-time", drawSceneErrorTime, new Set(askedRows().map((row) => row.scene)).size > 1 && new Set(askedRows().map((row) => row.subject)).size > 2],
].filter(([, , there]) => there);
for (const [id] of charts) show(id);
drawNavigation();

// Makes every box that scrolls reachable by keyboard.
for (const box of document.querySelectorAll("main .scroll, main .chart")) {
  const title = box.closest("section").querySelector("h2")?.textContent ?? box.closest("section").getAttribute("aria-label");
  for (const [name, value] of Object.entries({ tabindex: "0", role: "group", "aria-label": title })) box.setAttribute(name, value);
}

/** Draws a chart. If that fails, its section says so, and the other charts are still drawn. */
async function drawOne([id, chart]) {
  try {
    await chart();
  } catch (error) {
    document.body.setAttribute("data-error", String(error));
    element(id).append(made("p", `This chart cannot be drawn: ${error.message}`, { class: "bad" }));
  }
}

let calls = 0;
let drawing = Promise.resolve();
/**
 * Draws charts after those of earlier calls. If another call comes before these charts are drawn, they are
 * skipped.
 */
function drawCharts(some) {
  const call = ++calls;
  document.body.removeAttribute("data-drawn");
  drawing = drawing.then(() => call === calls && Promise.all(some.map(drawOne)))
    .then(() => call === calls && document.body.setAttribute("data-drawn", "true"));
}
drawCharts(charts);
// If nothing failed, the findings are below the charts. So the page draws the charts before it shows a
// finding.
report.headline.clean ? drawing.then(showAddress) : showAddress();
addEventListener("hashchange", showAddress);
const ofSubjects = charts.filter(([id]) => element("by-subject").contains(element(id)));
const ofAll = charts.filter(([, chart]) => chart === drawEarliness || (chart === drawErrorTime && !report.error_against_time.ladder));
if (hasPicker && ofSubjects.length > 0)
  drawPicker(() => {
    element("by-subject").classList.toggle("empty", chosenNames().length === 0);
    drawCharts(chosenNames().length === 0 ? ofAll : [...ofAll, ...ofSubjects]);
  });
