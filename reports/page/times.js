// Draws times of impact: their error against run time, a table, and histograms on both sides of t*, the exact
// earliest time.
"use strict";

const sortsOfTime = { "lower-bound": "lower bound", estimate: "estimate" };
/**
 * The encoding by which a chart distinguishes lower bounds from estimates. `looks` has two entries, such as
 * shapes or patterns of dashes: the first for lower bounds, the second for estimates.
 */
const bySort = (looks) => ({ field: "sort", type: "nominal", title: "time", scale: { domain: Object.values(sortsOfTime), range: looks },
  legend: { symbolFillColor: color("--ink"), symbolStrokeColor: color("--ink") } });

const timedRows = () => countRows(false).filter((row) => row.times_given > 0)
  .map((row) => ({ ...row, sort: sortsOfTime[row.time_sort] }));

// --- error against run time -----------------------------------------------------------------------

/** A row for each subject of the chart. A quantile of errors is the upper end of its bin. */
const earlinessRows = () => Object.entries(report.error_against_time.subjects)
  .filter(([, { time_sort }]) => time_sort !== "none")
  .map(([subject, row]) => ({ ...row, subject, sort: sortsOfTime[row.time_sort],
    median: row.median_time_error[1], q99: row.q99_time_error[1] }));

/** Draws a mark for each subject. */
function drawEarliness() {
  show("earliness-part");
  const rows = earlinessRows();
  const axis = logAxis(rows.flatMap((row) => [row.median, row.q99, row.max_time_error]));
  for (const row of rows)
    row.y = { median: axis.at(row.median), q99: axis.at(row.q99), largest: axis.at(row.max_time_error) };
  const times = rows.map((row) => row.ns_per_query);
  const ends = [0.6 * Math.min(...times), 1.7 * Math.max(...times)];
  const size = [Math.max(300, Math.min(900, element("how").clientWidth - 90)), 320];
  const front = report.error_against_time.front_by_earliness;
  const x = { field: "ns_per_query", type: "quantitative", title: "ns a query", scale: { type: "log", nice: false, domain: ends },
    axis: { grid: true, tickCount: 6, format: "~s" } };
  const y = (field) => ({ field: `y.${field}`, type: "quantitative", title: "|toi − t*|", scale: axis.scale, axis: axis.axis });
  const hue = { ...chosenColor(color("--soft")), legend: null };
  const tooltip = [{ field: "subject" }, { field: "sort", title: "time" }, { field: "ns_per_query", title: "ns a query", ...digits(4) },
    { field: "times_given", title: "times" }, { field: "late" }, { field: "median", title: "median of |toi − t*|, at most", ...digits(3) },
    { field: "q99", title: "99 %, at most", ...digits(3) }, { field: "max_time_error", title: "largest", ...digits(4) }];
  const own = { x, color: hue, tooltip };
  const tick = (field, width) => ({ mark: { type: "tick", orient: "horizontal", thickness: 2, width }, encoding: { ...own, y: y(field) } });
  const late = rows.filter((row) => row.late > 0);
  const names = rows.map((row) => ({ subject: row.subject, x: row.ns_per_query, y: row.y.median, rank: row.sort === sortsOfTime.estimate ? 1 : 0 }));
  return draw("earliness", "For each subject that gives times, the run time of a query, and how far its times are from the exact ones.", {
    width: size[0], height: size[1], data: { values: rows },
    layer: [
      { data: { values: rows.filter((row) => front.includes(row.subject)) },
        mark: { type: "line", interpolate: "step-after", strokeDash: [8, 5], color: color("--soft") }, encoding: { x, y: y("q99") } },
      { mark: { type: "rule", strokeWidth: 2 }, encoding: { ...own, y: y("median"), y2: { field: "y.largest" }, strokeDash: bySort([[1, 0], [4, 3]]) } },
      tick("q99", 14), tick("largest", 7),
      { mark: { type: "point", filled: true, size: 130, opacity: 0.9 },
        encoding: { ...own, y: y("median"), shape: bySort(["circle", "diamond"]) } },
      { data: { values: late }, mark: { type: "point", shape: "cross", angle: 45, size: 110, filled: true, opacity: 1,
        color: color("--bad"), stroke: color("--paper") }, encoding: { x, y: y("median"), tooltip } },
      ...nameLayers(names, x, y("median"), size),
    ],
  });
}

// --- table ----------------------------------------------------------------------------------------

/** The column of late times, for subjects that promise lower bounds. */
const lateTimes = { title: "late", number: (r) => r.late, text: (r) => (r.times_promised > 0 ? integer(r.late) : "–"), bad: (r) => r.late > 0 };
/**
 * The column of committed times. Such a time is a sound lower bound, but the rounded step to this time has
 * contact before the step ends.
 */
const committedSteps = { title: "committed", number: (r) => r.committed, text: (r) => (r.times_promised > 0 ? integer(r.committed) : "–"), bad: (r) => r.unsafe_steps > 0 };

function drawTimes() {
  const subjects = new Set(timedRows().map((row) => row.subject));
  if (subjects.size === 0) return;
  show("times-section");
  const byFamily = element("times-by-family").checked;
  const rows = (byFamily ? countRows(true) : classRows()).filter((row) => subjects.has(row.subject));
  const ifGiven = (column) => ({ ...column, text: (r) => (r.times_given > 0 ? column.text(r) : "–") });
  const upperEnd = (title, field) => ifGiven({ title, number: (r) => r[field][1], text: (r) => short(r[field][1]) });
  const invalid = (r) => r.faults.invalid ?? 0;
  fillTable(element("times"), [
    ...columnsOf("subject", "kind", "class", ...(byFamily ? ["family"] : [])),
    { title: "sort", text: (r) => sortsOfTime[r.time_sort] ?? "–" }, measures.times_given, lateTimes, committedSteps, measures.stuck,
    { title: "invalid", number: invalid, text: (r) => integer(invalid(r)), bad: (r) => invalid(r) > 0 }, measures.unknown,
    upperEnd("early: median", "median_early"), upperEnd("99 %", "q99_early"), ifGiven(number("most", "max_early")),
    ifGiven(number("after t*", "max_after")), upperEnd("travelled / B", "q99_travelled"),
  ], rows, true);
}

// --- histograms -----------------------------------------------------------------------------------

/**
 * Joins the two histograms of a subject and kind into one histogram, from the earliest time to the latest.
 * Bin i of the times before t* (the exact earliest time) is at place -i, and bin i of the times after t* is
 * at place i.
 */
function binsOfErrors(row) {
  const { early_histogram: early, after_histogram: after } = row;
  const borders = report.histogram_borders.map(short);
  const range = (i) => (i === early.length - 1 ? `at least ${borders[i]}` : `${borders[i]} to ${borders[i + 1]}`);
  const bin = (place, count, error) => ({ subject: row.subject, kind: row.kind, sort: row.sort, place, count, error });
  return [
    ...early.map((n, i) => bin(-i, n, `early by ${range(i)}`)).slice(1).reverse(),
    bin(0, early[0] + after[0], `less than ${borders[1]} away`),
    ...after.map((n, i) => bin(i, n, `${range(i)} after t*`)).slice(1),
  ];
}

/** Draws a strip for each chosen subject and kind. All strips have the same axis. */
function drawTimeErrors() {
  const rows = timedRows();
  const all = rows.flatMap(binsOfErrors);
  const used = all.filter((bin) => bin.count > 0).map((bin) => bin.place);
  const [first, last] = [Math.min(0, ...used) - 3, Math.max(0, ...used) + 3];
  // The lower border of bin i is at place i - 1/2; a tick stands at every fourth power of ten.
  const [lowest, ratio] = [report.histogram_borders[1], report.histogram_borders[2] / report.histogram_borders[1]];
  const perTick = Math.round(4 / Math.log10(ratio));
  const ticks = [0];
  for (let place = perTick + 0.5; place < last || -place > first; place += perTick) ticks.push(place, -place);
  const label = `datum.value === 0 ? '0' : (datum.value < 0 ? '−' : '') + digits(${lowest} * pow(${ratio}, abs(datum.value) - 0.5), 3)`;
  const x = { field: "place", type: "quantitative", title: "toi − t*", scale: { domain: [first, last], nice: false },
    axis: { values: ticks.filter((place) => place >= first && place <= last), labelExpr: label } };
  const names = chosenNames().filter((name) => rows.some((row) => row.subject === name));
  const most = Math.max(...all.map((bin) => bin.count));
  const strips = (kind, hasNames) => ({
    title: kindTitles[kind], transform: [{ filter: `datum.kind === "${kind}"` }],
    facet: { row: { field: "row", title: null, sort: names.map((name) => rowName(rows, name)),
      header: hasNames ? { labelAngle: 0, labelAlign: "left", labelPadding: 12 } : { labels: false } } },
    spacing: 6,
    spec: {
      width: panelWidth(400, 330), height: 44,
      layer: [
        { mark: { type: "area", interpolate: "step", line: { strokeWidth: 1 }, opacity: 0.6 },
          encoding: { x, color: { ...chosenColor(), legend: null },
            y: { field: "count", type: "quantitative", title: null, stack: null, scale: { type: "symlog", domain: [0, most] }, axis: { values: [0, 10, 1000, 100000], labelExpr: "format(datum.value, '~s')" } },
            tooltip: [{ field: "subject" }, { field: "error" }, { field: "count", title: "times" }] } },
        { data: { values: [{ place: 0.5 }] }, mark: { type: "rule", color: color("--bad") }, encoding: { x } },
      ],
    },
  });
  const kinds = kindNames.filter((kind) => rows.some((row) => row.kind === kind));
  // A subject that was not asked about a kind gets an empty strip for this kind, so that each strip stands
  // beside its subject's name.
  const empty = kinds.flatMap((kind) => names.map((subject) => ({ subject, kind, place: 0, count: 0 })));
  const values = [...all.filter((bin) => isChosen(bin) && bin.place >= first && bin.place <= last),
    ...empty.filter(({ subject, kind }) => !rows.some((row) => row.subject === subject && row.kind === kind))]
    .map((bin) => ({ ...bin, row: rowName(rows, bin.subject) }));
  return draw("time-errors", "The number of times at each difference from the exact earliest time, on both sides of 0.",
    { data: { values }, columns: 2, concat: kinds.map((kind, i) => strips(kind, i % 2 === 0)) });
}

/** The name of a subject's strip, with the sort of the subject's times. */
const rowName = (rows, subject) => `${subject} (${rows.find((row) => row.subject === subject).sort})`;
