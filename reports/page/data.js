// Reads the report's data, which is part of the page.
"use strict";

/**
 * Replaces the largest double by infinity. JSON has no infinity, so the largest double stands for a distance
 * divided by a bound of 0.
 */
const withInfinity = (value) => (Array.isArray(value) ? value.map(withInfinity) : value === Number.MAX_VALUE ? Infinity : value);
const report = JSON.parse(document.getElementById("report").textContent,
  (key, value) => (/over_bound$|^ratio$/.test(key) ? withInfinity(value) : value));

/**
 * The folder of this page, if the page is a file; "" otherwise. In the commands that replay findings, this
 * path stands in front of `cases/`. So the commands work in any working directory, even after the report has
 * been copied together with its cases.
 */
const ownFolder = (() => {
  if (location.protocol !== "file:") return "";
  try {
    return decodeURIComponent(location.pathname.replace(/[^/]*$/, ""));
  } catch {
    return ""; // the folder's name is not UTF-8, so commands work in the report's folder
  }
})();
/** A text in the form that a shell reads as one word. */
const shellQuoted = (text) => (/^[\w./@%+=:,-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
/** The command that replays a finding. */
const replayCommand = ({ again }) => again.replace(/(?<= )cases\/\S+/, (file) => shellQuoted(ownFolder + file));

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

/** Rows [{subject, kind, class, ...counts}] with the sums over the families of each class. */
const classRows = () => Object.entries(report.subjects).flatMap(([subject, ofKind]) =>
  Object.entries(ofKind).flatMap(([kind, counts]) =>
    Object.entries(counts.classes).map(([name, each]) => ({ subject, kind, family: "", class: name, ...each }))));

/** Whether a subject is not on the precision ladder, which has one algorithm over many scalars. */
const isNoRung = ({ subject, algorithm }) => subject === algorithm;

/**
 * Whether distances are fractions of the bound that the subject claims. If not, they are in units of wang's
 * bound.
 */
const isOfClaim = (row) => row.bound_of_distances === "claimed";
/**
 * The mark of a distance: "**" unless the distance is a fraction of a claimed bound. Elements of the class
 * "units" explain this mark.
 */
const unitMark = (row) => (isOfClaim(row) ? "" : "**");
/**
 * The mark of a subject: "**" unless the subject's distances of all kinds are fractions of a claimed bound.
 */
const markOf = (subject) => (Object.values(report.subjects[subject]).every(isOfClaim) ? "" : "**");

/**
 * The separation of a query. It is the number after the coordinates, and 0 if there is no such number. Each
 * vertex has six coordinates.
 */
const separationOf = (query) => (query.length % 6 === 1 ? query.at(-1) : 0);
