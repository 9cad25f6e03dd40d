// Draws the history of nights: a row for each night, charts for each subject, and when each way to fail was
// seen.
"use strict";

const { nights, ways_to_fail: ways } = JSON.parse(element("history").textContent);
const latest = nights.at(-1);

/** A night's name. If the night has a report, the name is a link to the report. */
const link = (night) => (night.page ? made("a", night.name, { href: `./${night.page.split("/").map(encodeURIComponent).join("/")}` }) : night.name);
const verdictOf = (night) => (!night.page ? "no report" : night.clean ? "ok" : "FAIL");

function drawHead() {
  element("headline").textContent = latest.headline;
  element("headline").classList.toggle("bad", !latest.clean);
  document.title = `${verdictOf(latest)}: nearmiss history`;
  element("latest").append(`${counted(nights.length, "night", "nights")}, the last one `, link(latest));
}

function drawNights() {
  const counts = (title, bad) => {
    const sum = (night) => night.events.filter(({ what }) => what === title).reduce((all, { count }) => all + count, 0);
    return { title, number: sum, text: (night) => (sum(night) > 0 ? integer(sum(night)) : ""), bad: (night) => bad && sum(night) > 0 };
  };
  const changes = (night) => {
    const lines = night.events.map(({ subject, text }) => made("li", [made("strong", subject || "the oracle"), `: ${text}`]));
    if (!night.page) lines.push(made("li", night.headline));
    if (night.went_back) lines.push(made("li", "The clock was set back: earlier nights have later dates."));
    return made("ul", lines);
  };
  fillTable(element("nights"), [
    { title: "night", text: link },
    { title: "verdict", text: verdictOf, bad: (night) => !night.clean },
    { title: "changes", text: changes },
    counts("new", true), counts("gone"), counts("worse", true), counts("better"), counts("slower", true), counts("faster"),
    count("cases", "cases"), { title: "run time", number: (night) => night.seconds, text: (night) => (night.page ? duration(night.seconds) : "") },
  ], [...nights].reverse());
}

/**
 * The nightly campaigns that put `subject` on trial, each with the subject's counts of that night. `is_other`
 * says whether the subject's code has changed since the previous campaign in this list.
 */
function nightsOf(subject) {
  const asked = nights.map((night, index) => ({ index, night, of: night.subjects[subject] })).filter(({ night }) => Object.hasOwn(night.subjects, subject));
  return asked.map(({ index, night, of }, i) => ({ index, name: night.name, ...of,
    per_second: night.seconds > 0 ? of.queries / night.seconds : null,
    is_other: i > 0 && (of.code !== asked[i - 1].of.code || of.build !== asked[i - 1].of.build) }));
}

const inClasses = (rows) => rows.flatMap((row) => Object.entries(row.classes ?? {}).filter(([, of]) => of.collisions > 0)
  .map(([name, of]) => ({ ...row, class: name, share: of.false_negatives / of.collisions, ...of })));
const panels = [
  { title: "missed", field: "share", rows: inClasses, format: "share", hue: "class",
    tooltip: [{ field: "class" }, { field: "false_negatives", title: "missed" }, { field: "collisions", title: "collisions" }] },
  { title: "false positives", field: "false_positive_rate", rows: (rows) => rows, format: "share", tooltip: [{ field: "false_positive_rate", title: "false positives", ...asShare }] },
  { title: "ns a query", field: "ns_per_query", rows: (rows) => rows, tooltip: [{ field: "ns_per_query", title: "ns a query", ...digits(3) }] },
  { title: "queries a second of the night", field: "per_second", rows: (rows) => rows, tooltip: [{ field: "per_second", title: "queries a second", ...digits(3) }] },
];

/** A chart over nights. A vertical line marks each night in which the subject's code changed. */
function panelSpec({ title, field, rows: rowsOf, format, hue, tooltip }, all) {
  const rows = rowsOf(all).filter((row) => Number.isFinite(row[field]));
  const x = { field: "index", type: "quantitative", title: null, scale: { domain: [-0.5, nights.length - 0.5], nice: false },
    axis: { grid: false, tickMinStep: 1, labelExpr: `slice(${JSON.stringify(nights.map(({ name }) => name))}[datum.value] || '', 5, 10)`, labelOverlap: true } };
  const y = { field, type: "quantitative", title: null, scale: { zero: true, nice: true, ...(rows.some((row) => row[field] > 0) ? {} : { domain: [0, 1] }) },
    axis: { tickCount: 4, ...(format === "share" ? { labelExpr: "share(datum.value)" } : { labelExpr: "digits(datum.value, 3)" }) } };
  const own = hue ? { color: { field: hue, type: "nominal", legend: { title: null, orient: "top" }, scale: { domain: ["ordinary", "degenerate", "extreme", "unclassified"].filter((each) => rows.some((row) => row.class === each)), range: palette } } } : { color: { value: color("--first") } };
  const others = all.filter((row) => row.is_other);
  return {
    width: "container", height: 130, title: { text: title, anchor: "start", fontSize: 12 },
    layer: [
      { data: { values: others }, mark: { type: "rule", color: color("--soft"), strokeDash: [3, 3] }, encoding: { x, tooltip: [{ field: "name", title: "night" }, { field: "code" }] } },
      { data: { values: rows }, mark: { type: "line", point: { size: 24 }, strokeWidth: 1.4 }, encoding: { x, y, ...own, tooltip: [{ field: "name", title: "night" }, { field: "code" }, ...tooltip] } },
    ],
  };
}

const names = [...new Set(nights.flatMap((night) => Object.keys(night.subjects)))];

async function drawSubjects() {
  const isFailing = (name) => nightsOf(name).at(-1).clean === false;
  names.sort((a, b) => isFailing(b) - isFailing(a) || (a < b ? -1 : 1));
  for (const [i, name] of names.entries()) {
    const rows = nightsOf(name);
    const now = rows.at(-1);
    const versions = rows.filter((row, at) => at === 0 || row.is_other).map((row, at, all) => `${at > 0 && row.code === all[at - 1].code ? row.build : row.code} since ${row.name.slice(0, 10)}`);
    const charts = panels.map((_, j) => made("div", [], { id: `chart${i}-${j}`, class: "chart" }));
    element("subjects").append(made("div", [made("h3", name), made("p", [made("span", now.clean ? "ok" : "FAIL", now.clean ? {} : { class: "bad" }), `: ${now.text}`]),
      small(versions.length > 6 ? `${versions.length} versions; the last: ${versions.at(-1)}` : versions.join(", ")), made("div", charts, { class: "panels" })]));
    for (const [j, panel] of panels.entries()) await draw(`chart${i}-${j}`, `${panel.title} of ${name} in each night`, panelSpec(panel, rows));
  }
}

function drawWays() {
  if (ways.length === 0) return;
  show("ways-section");
  const most = 100;
  const night = (field) => ({ title: field, number: (way) => way[field],
    text: (way) => made("span", [link(nights[way[field]]), way[field] === 0 && nights[0].has_baseline ? " or before" : "", ` ${way[`${field}_code`]}`]) });
  const columns = [
    { title: "subject", text: (way) => way.subject || "the oracle" }, text("failure", "what"), text("way to fail", "signature"),
    { title: "now", text: (way) => (way.lasts ? (way.last === nights.length - 1 ? "seen" : "seen when it was last asked") : way.gone === null ? "not seen since" : way.fixed ? `fixed ${way.fixed}` : "gone"), bad: (way) => way.last === nights.length - 1 },
    night("first"), night("last"), count("nights", "nights"), count("queries", "seen"),
  ];
  const fill = (some) => fillTable(element("ways"), columns, some, true);
  fill(ways.slice(0, most));
  if (ways.length <= most) return;
  show("more-ways");
  element("more-ways").textContent = `show all ${integer(ways.length)}`;
  element("more-ways").addEventListener("click", () => {
    fill([...ways]);
    element("more-ways").remove();
  });
}

async function drawAll() {
  try {
    drawHead();
    drawNights();
    drawWays();
    if (names.length > 0) show("subjects-section");
    for (const section of document.querySelectorAll("main > section:not([hidden]) > h2"))
      document.querySelector("nav").append(made("a", section.textContent, { href: `#${section.parentNode.id}` }));
    await drawSubjects();
    document.body.setAttribute("data-drawn", "true");
  } catch (error) {
    document.body.setAttribute("data-error", String(error));
    element("headline").after(made("p", `A part of this page cannot be drawn: ${error.message}`, { class: "bad" }));
  }
}
drawAll();
