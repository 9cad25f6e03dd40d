// Tests report.json against its schema.
import assert from "node:assert/strict";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import ajv from "../../../reports/page/node_modules/ajv/dist/2020.js";
import { folder, jsonOf, plugin, run } from "./session.mjs";

const schema = JSON.parse(readFileSync(new URL("../../../reports/report.schema.json", import.meta.url), "utf8"));
const isValid = new ajv.default({ strict: false, allErrors: true }).compile(schema);

/** The schema errors of a report, without list indices: an error in several entries counts once. */
const errors = (report) => (isValid(report) ? []
  : [...new Set(isValid.errors.map(({ instancePath, message, params }) => `${instancePath.replace(/\/\d+/g, "/N")} ${message} ${JSON.stringify(params)}`))]);

/**
 * All reports of the other tests satisfy the schema. A report with an added field or a changed type breaks it.
 */
export function everyReportFollowsItsSchema() {
  for (const [name, ...options] of [["values", "--subject", `${plugin("sampling")}:sampling:tolerance=*`, "--values", "0.5,1e-9", "--cases", "200"], ["factors", "--tolerance", "rho", "--time", "1s"]]) {
    run("tightness", ...options, "--db", `${name}.db`);
    run("report", `${name}.db`, "-o", name);
  }
  const names = readdirSync(folder).filter((name) => existsSync(join(folder, name, "report.json")));
  assert.ok(names.length > 20);
  const sections = new Set();
  for (const name of names) {
    const report = jsonOf(name);
    for (const section of Object.keys(report)) sections.add(section);
    assert.deepEqual(errors(report), [], name);
  }
  for (const section of Object.keys(schema.properties)) assert.ok(sections.has(section), `no report has ${section}`);
  const { subjects, verdicts, findings } = jsonOf("found");
  for (const wrong of [{ schema_version: 1 }, { unknown: 1 }, { verdicts: verdicts.map((each) => ({ ...each, clean: "yes" })) },
    { findings: findings.map((each) => ({ ...each, extra: 0 })) }, { subjects: { ...subjects, wang: { xx: subjects.wang.vt } } },
    { verdicts: verdicts.map(({ counts, ...rest }) => ({ ...rest, counts: { ...counts, queries: -1 } })) }])
    assert.notDeepEqual(errors({ ...jsonOf("found"), ...wrong }), [], JSON.stringify(wrong).slice(0, 60));
}
