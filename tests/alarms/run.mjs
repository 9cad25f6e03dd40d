// Counts how often a report with a baseline raises an alarm. For pairs of equal campaigns, every alarm is
// false. Other pairs have a planted defect in one query of 3,000, in a subject without failures or in a
// subject that fails anyway.
//
//     node tests/alarms/run.mjs NEARMISS PLUGINS [PAIRS [CASES [equal|wang|basic]]]
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { readOptions } from "../../tools/options.mjs";

const [nearmiss, plugins, pairs = "100", cases = "300000", only] = readOptions({}, true).positionals;
if (!nearmiss || !plugins) {
  console.error("run.mjs: expected NEARMISS PLUGINS");
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), "nearmiss-alarms-"));

function night(name, seed, subjects, planted) {
  const { status, stderr } = spawnSync(resolve(nearmiss),
    ["fuzz", "--cases", cases, "--seed", `${seed}`, "--subject", subjects, "--db", `${name}.db`],
    { cwd: folder, env: { ...process.env, NEARMISS_PLANTED: `${planted}` }, encoding: "utf8" });
  if (status !== 0 && status !== 1) throw new Error(`fuzz ended with ${status}: ${stderr}`);
}

/** New ways to fail and worse rates since the baseline. */
function alarms() {
  spawnSync(resolve(nearmiss), ["report", "now.db", "--baseline", "before.db", "-o", "report"], { cwd: folder });
  const { baseline } = JSON.parse(readFileSync(join(folder, "report", "report.json")));
  const found = [...baseline.new_signatures.map((each) => `${each.what} of ${each.subject}, ${each.signature}`),
    ...baseline.changed_rates.filter((rate) => rate.worse).map((rate) => `${rate.what} of ${rate.subject} in ${rate.family}`)];
  for (const name of ["before.db", "now.db", "report"]) rmSync(join(folder, name), { recursive: true });
  return found;
}

function count(what, subjects, planted, seed) {
  let noticed = 0;
  for (let pair = 0; pair < Number(pairs); ++pair) {
    night("before", seed + 2 * pair, subjects, 0);
    night("now", seed + 2 * pair + 1, subjects, planted);
    const found = alarms();
    noticed += found.length > 0 ? 1 : 0;
    if (planted === 0 && found.length > 0) console.log(`  seeds ${seed + 2 * pair} and ${seed + 2 * pair + 1}: ${found.join("; ")}`);
  }
  console.log(`${what}: ${noticed} alarms in ${pairs} pairs of ${cases} cases`);
}

try {
  execFileSync(resolve(nearmiss), ["--version"]);
  if (!only || only === "equal") count("equal campaigns of wang, basic, basic-plain", "wang,basic,basic-plain", 0, 1);
  for (const [i, subject] of ["wang", "basic"].entries())
    if (!only || only === subject)
      count(`a defect of one in 3,000 planted in ${subject}`, resolve(plugins, `planted_in_${subject}.so`), 3000, 1001 * (i + 1));
} finally {
  rmSync(folder, { recursive: true });
}
