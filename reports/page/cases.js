// Draws single queries: findings, the farthest false positives, and the earliest and latest times.
"use strict";

const failureTitles = { "false-negative": "missed collision", late: "late time", "refuted-bound": "beyond its bound", fault: "no answer",
  committed: "step with contact", "unsafe-step": "unsafe step" };

/** The title of a finding, such as "missed collision of basic". */
function failureTitle(finding) {
  const what = `${failureTitles[finding.what] ?? finding.what} of ${finding.subject || "the oracle"}`;
  if (finding.late_by) return `${what}, by ${short(finding.late_by)} of the step`;
  return finding.ratio ? `${what}, ${timesTheBound(finding.ratio, finding)}` : what;
}

/** A short hash of a text, the same in every report. */
function digest(text) {
  let [a, b] = [0x9e3779b9, 0x85ebca6b];
  for (const letter of text) {
    a = Math.imul(a ^ letter.codePointAt(0), 0x01000193);
    b = Math.imul(b ^ (letter.codePointAt(0) + (a >>> 16)), 0x5bd1e995);
  }
  return [a, b].map((each) => (each >>> 0).toString(36).padStart(7, "0")).join("");
}

/** The address of a finding on this page. It is the same in every report that shows the finding. */
const idOf = ({ subject, kind, what, signature, class: own, provenance }) => `finding-${digest([subject, kind, what, signature, own, provenance].join("\n"))}`;

/** A link to a finding, which works even if the filter hides the finding. */
function findingLink(title, index) {
  const link = made("a", title, { href: `#${idOf(report.findings[index])}` });
  link.addEventListener("click", () => setTimeout(() => showFinding(index)));
  return link;
}

function linkButton(finding) {
  const icon = svgMade("svg", { viewBox: "0 0 16 16", "aria-hidden": "true" },
    svgMade("path", { d: "M7 9.5l3-3M6.5 5l2-2a2.8 2.8 0 0 1 4 4l-2 2M9.5 11l-2 2a2.8 2.8 0 0 1-4-4l2-2" }));
  const button = copyButton(`${location.href.replace(/#.*/, "")}#${idOf(finding)}`, icon);
  for (const [name, value] of Object.entries({ class: "link", title: "copy the link to this finding", "aria-label": "copy the link to this finding" })) button.setAttribute(name, value);
  return button;
}

/**
 * A card with text, and with a picture that the user can enlarge.
 * @param shown what the picture shows (makeViewer)
 * @param onOpen is called when the user enlarges the picture
 */
function pictureCard(shown, content, attributes = {}, onOpen = () => {}) {
  const card = made("article", [], { ...attributes, class: "card" });
  const text = made("div", content);
  const button = (title, isOpen, name) => {
    const node = made("button", title, { type: "button", class: name, "aria-expanded": String(!isOpen), "aria-label": isOpen ? "enlarge the picture" : "reduce the picture" });
    node.addEventListener("click", () => {
      draw(isOpen);
      card.querySelector("button[aria-expanded]").focus();
      if (isOpen) onOpen();
    });
    return node;
  };
  function draw(isOpen) {
    card.classList.toggle("open", isOpen);
    if (isOpen) return card.replaceChildren(...makeViewer(shown), text, button("×", false, "close"));
    const { svg, draw: drawSmall } = makePicture(shown, [220, 220]);
    drawSmall({ yaw: -0.6, pitch: 0.5, zoom: 1, time: shown.time });
    return card.replaceChildren(made("figure", [button(svg, true, "thumbnail"), made("figcaption", pictureLegend(shown))]), text);
  }
  card.open = () => card.classList.contains("open") || draw(true);
  draw(false);
  return card;
}

/**
 * A query that the page shows after a click on `title`. A button copies the query's certificate, if there is
 * one.
 */
const fold = (title, query, file, certificate) => made("details", [made("summary", title), ...(file ? [made("a", file, { href: file })] : []), queryText(query), copyQuery(query),
  ...(certificate ? [" ", copyButton(certificate, "copy the certificate")] : [])]);

/** A finding: its picture, what failed and how often, the command that replays it, and its queries. */
const findingCard = (finding, attributes = { id: idOf(finding), tabindex: -1 }) => pictureCard({ ...finding, query: finding.shrunk }, [
  ...(finding.new ? [made("div", "NEW since the baseline", { class: "bad" })] : []),
  made("h3", [failureTitle(finding), " ", linkButton(finding)]),
  made("div", `${finding.class} query${finding.is_shrunk ? "" : ", not shrunk"}; ${finding.signature}, ${finding.seen === 1 ? "seen once" : `seen ${integer(finding.seen)} times in all classes`}`),
  made("div", finding.explanation),
  small(`${kindTitles[finding.kind]}, from ${finding.provenance}`),
  ...(finding.errors ? [made("details", [made("summary", "its standard error, and the stack of a crash"), made("pre", finding.errors.join("\n"))])] : []),
  command(replayCommand(finding)),
  ...(finding.is_shrunk ? [fold("the shrunk query", finding.shrunk, finding.file, finding.certificate)] : []),
  fold("the original query", finding.original, finding.original_file, finding.is_shrunk ? null : finding.certificate),
  ...(String(finding.simplest) === String(finding.shrunk) ? [] : [fold(`the simplest query of any class (${finding.simplest_class})`, finding.simplest)]),
], attributes, () => history.replaceState(null, "", `#${idOf(finding)}`));

// --- findings -------------------------------------------------------------------------------------

/**
 * The findings. Each entry has a finding, its index in the report, and the text in which the filter looks for
 * words. New findings come first, then the others; within both groups, the findings have the order of the
 * report (Campaign::findings).
 */
const findings = report.findings.map((finding, index) => ({ finding, index,
  words: [failureTitle(finding), finding.what, finding.signature, finding.kind, kindTitles[finding.kind], finding.family, finding.provenance,
    finding.explanation].join(" ").toLowerCase() }))
  .sort((a, b) => Number(b.finding.new) - Number(a.finding.new));
const findingsAtOnce = 24;
/**
 * The filter that hides nothing. A filter has the chosen value of each field ("" for all), the words that
 * must occur, and the largest number of findings to show.
 */
const noFilter = { subject: "", what: "", kind: "", class: "", family: "", words: "", most: findingsAtOnce };
const filter = { ...noFilter };

const filteredFindings = () => {
  const words = filter.words.toLowerCase().split(/\s+/).filter(Boolean);
  return findings.filter((each) => ["subject", "what", "kind", "class", "family"].every((field) => filter[field] === "" || each.finding[field] === filter[field]) &&
    words.every((word) => each.words.includes(word)));
};

function drawCards() {
  const some = filteredFindings();
  element("findings").replaceChildren(...some.slice(0, filter.most).map(({ finding }) => findingCard(finding)));
  element("findings-count").textContent = `${integer(Math.min(some.length, filter.most))} of ${integer(some.length)} shown` +
    (some.length < findings.length ? `, out of ${integer(findings.length)}` : "");
  element("more-findings").toggleAttribute("hidden", some.length <= filter.most);
}

/** Shows only the findings with these values; `values` maps fields of the filter to values. */
function filterFindings(values) {
  Object.assign(filter, noFilter, values);
  for (const input of document.querySelectorAll("#findings-filter [name]")) input.value = filter[input.name];
  drawCards();
}

/**
 * Opens a finding. If the filter hides the finding, first changes the filter to show all findings of its
 * subject.
 */
function showFinding(index) {
  const finding = report.findings[index];
  const id = idOf(finding);
  if (!element(id)) {
    const place = findings.filter((each) => each.finding.subject === finding.subject).findIndex((each) => each.index === index);
    filterFindings({ subject: finding.subject, most: Math.max(findingsAtOnce, place + 1) });
  }
  element(id).open();
  element(id).scrollIntoView();
  element(id).focus({ preventScroll: true });
}

/** Opens the finding that the page's address names. */
function showAddress() {
  if (!location.hash.startsWith("#finding-")) return;
  const index = report.findings.findIndex((finding) => `#${idOf(finding)}` === location.hash);
  if (index >= 0) return void showFinding(index);
  element("findings-note").prepend(made("strong", "This report does not have the finding that the page's address names. ", { class: "bad" }));
  element("findings-section").scrollIntoView();
}

function drawFilter() {
  const values = (field) => [...new Set(report.findings.map((each) => each[field]))].sort();
  const titles = { what: failureTitles, kind: kindTitles, subject: { "": "the oracle" } };
  const choice = (field, title) => {
    const select = made("select", [made("option", "all", { value: "" }),
      ...values(field).filter(Boolean).map((value) => made("option", Object.hasOwn(titles[field] ?? {}, value) ? titles[field][value] : value, { value }))], { name: field });
    return made("label", [`${title} `, select]);
  };
  element("findings-filter").append(choice("subject", "subject"), choice("what", "failure"), choice("kind", "kind"), choice("class", "class"),
    choice("family", "family"),
    made("label", ["with the words ", made("input", [], { name: "words", type: "search" })]));
  element("findings-filter").addEventListener("input", ({ target }) => {
    Object.assign(filter, { [target.name]: target.value, most: findingsAtOnce });
    drawCards();
  });
  // Enter must not reload the page.
  element("findings-filter").addEventListener("submit", (event) => event.preventDefault());
  element("more-findings").addEventListener("click", () => {
    const next = filter.most;
    filter.most += findingsAtOnce;
    drawCards();
    element("findings").children[next].focus(); // the button that had the focus may be gone
  });
}

/**
 * Draws the simplest failure of the first failed subject in the page's first table; if no subject has one,
 * the oracle's.
 */
function drawExample() {
  const worst = inOrder(report.verdicts).find(({ clean, finding }) => !clean && finding !== null);
  const index = worst ? worst.finding : report.findings.findIndex(({ subject }) => subject === ""); // the oracle's
  if (report.headline.clean || index < 0) return;
  show("example-section");
  const card = findingCard(report.findings[index], {});
  card.open();
  element("example").append(card);
}

function drawFindings() {
  show("findings-section");
  if (report.headline.clean) element("glossary").before(element("findings-section"));
  const isCommitted = ({ what }) => what === "committed";
  const failures = report.signatures.filter((each) => !isCommitted(each));
  const times = (some) => integer(some.reduce((sum, each) => sum + each.seen, 0));
  if (report.signatures.length === 0) {
    element("findings-part").remove();
    element("findings-note").textContent = "None: no missed collision, no late time, no bound refuted, no disagreement of the oracle's methods.";
    return;
  }
  element("findings-note").textContent = `${times(failures)} failures in ${integer(failures.length)} ways. The first few of each way ` +
    "are kept, and shrunk to the simplest query that fails in the same way." + (failures.length === report.signatures.length ? "" :
    ` So are some of the ${times(report.signatures.filter(isCommitted))} queries in which the step to a sound time, once rounded, has contact.`);
  if (report.common_factors) show("common-factors-part");
  for (const each of report.common_factors ?? [])
    element("common-factors").append(made("li", `${each.subject} ${each.kind}, ${each.family}: ${each.text}.`));
  drawFilter();
  drawCards();
}

function drawFarthest() {
  const rows = countRows(false).map(farthestOf).filter(Boolean);
  if (rows.length === 0) return;
  show("farthest-section");
  element("farthest").append(...rows.map((r) => pictureCard(r, [
    made("h3", `${r.subject} ${r.kind}`), made("div", timesTheBound(r.ratio, r)), small(`from ${r.provenance}`), fold("the query", r.query, r.file),
  ])));
}

function drawExtremeTimes() {
  const rows = report.extreme_times;
  if (rows.length === 0) return;
  show("extreme-times-section");
  // A time after t*, the exact earliest time, is not late if the primitives come no closer than the
  // separation before that time. If a subject gives both lower bounds and estimates, the report does not say
  // whether a time is a lower bound or an estimate, so the page does not call the time late.
  const isLate = ({ subject, kind, side }) => {
    const { late, after_histogram: after } = report.subjects[subject][kind];
    return side === "after" && late === after.reduce((a, b) => a + b, 0);
  };
  const what = (r) => (isLate(r) ? "late" : r.side === "early" ? "early" : "after t*");
  element("extreme-times").append(...rows.map((r) => pictureCard(r, [
    made("h3", `${r.subject} ${r.kind}`, isLate(r) ? { class: "bad" } : {}), made("div", `${what(r)} by ${short(r.error)} of the step`),
    small(`from ${r.provenance}`), fold("the query", r.query),
  ])));
}
