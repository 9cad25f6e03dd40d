// Makes the table of environments of a report: table.mjs ENVIRONMENTS.tsv REPORT.json TABLE.json. Each line
// of the first file has the name of a plug-in, and its CCD, compiler, flags and mode.
import { readFileSync, writeFileSync } from "node:fs";

const [environments, report, table] = process.argv.slice(2);
const { subjects, findings } = JSON.parse(readFileSync(report));

const rows = readFileSync(environments, "utf8").trim().split("\n").map((line) => {
  const [name, subject, compiler, flags, mode] = line.split("\t");
  const kinds = Object.values(subjects[name] ?? {});
  const sum = (count) => kinds.reduce((total, kind) => total + count(kind), 0);
  const failures = findings.filter((finding) => finding.subject === name);
  const first = failures.find((finding) => finding.what === "false-negative") ?? failures[0];
  return {
    subject, compiler, flags, mode,
    queries: sum((kind) => kind.queries), collisions: sum((kind) => kind.collisions), missed: sum((kind) => kind.false_negatives),
    false_positives: sum((kind) => kind.false_positives), refuted_bounds: sum((kind) => kind.refuted_bounds),
    faults: sum((kind) => Object.values(kind.faults).reduce((a, b) => a + b, 0)),
    first: first ? `${first.what} ${first.provenance}` : null,
  };
});
writeFileSync(table, `${JSON.stringify(rows, null, 1)}\n`);

const number = (n) => n.toLocaleString("en-US");
const lines = [["CCD", "compiler", "flags", "mode", "queries", "collisions", "missed", "false pos.", "beyond", "no answer", "guarantee", "first"]];
for (const row of rows)
  lines.push([row.subject, row.compiler, row.flags, row.mode,
    ...[row.queries, row.collisions, row.missed, row.false_positives, row.refuted_bounds, row.faults].map(number),
    row.missed > 0 ? "MISSES" : row.faults > 0 ? "gives no answer" : "keeps it", row.first ?? ""]);
const widths = lines[0].map((_, i) => Math.max(...lines.map((line) => line[i].length)));
for (const line of lines)
  console.log(line.map((cell, i) => (i >= 4 && i <= 9 ? cell.padStart(widths[i]) : cell.padEnd(widths[i]))).join("  ").trimEnd());
