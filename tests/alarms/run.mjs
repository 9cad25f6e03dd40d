// Counts how often a report with a baseline raises an alarm. For pairs of equal campaigns, every alarm is
// false. Other pairs have a planted defect: one query of 3,000 is answered wrongly, by a subject without failures or by a
// subject that fails anyway; or one family takes 1.5 times as long. Campaigns have a number of cases, or a time such as 20s.
//
//     node tests/alarms/run.mjs [--jobs N] NEARMISS PLUGINS [PAIRS [CASES [equal|wang|basic|slower]]]
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { readOptions } from "../../tools/options.mjs";

const { options, positionals } = readOptions({ jobs: { type: "string" } }, true);
const [nearmiss, plugins, pairs = "100", cases = "300000", only] = positionals;
if (!nearmiss || !plugins) {
  console.error("run.mjs: expected NEARMISS PLUGINS");
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), "nearmiss-alarms-"));
const planted = (subject) => resolve(plugins, `planted_in_${subject}.so`);
const length = [/^\d+$/.test(cases) ? "--cases" : "--time", cases, ...(options.jobs ? ["--jobs", options.jobs] : [])];

function night(name, seed, subjects, defect) {
  const { status, stderr } = spawnSync(resolve(nearmiss),
    ["fuzz", ...length, "--seed", `${seed}`, "--subject", subjects, "--db", `${name}.db`],
    { cwd: folder, env: { ...process.env, ...defect }, encoding: "utf8" });
  if (status !== 0 && status !== 1) throw new Error(`fuzz ended with ${status}: ${stderr}`);
}

/** New ways to fail, worse rates, and run times that have changed since the baseline. */
function alarms() {
  spawnSync(resolve(nearmiss), ["report", "now.db", "--baseline", "before.db", "-o", "report"], { cwd: folder });
  const { baseline } = JSON.parse(readFileSync(join(folder, "report", "report.json")));
  const found = [...baseline.new_signatures.map((each) => `${each.what} of ${each.subject}, ${each.signature}`),
    ...baseline.gone_signatures.map((each) => `no ${each.what} of ${each.subject}, ${each.signature}`),
    ...baseline.changed_rates.filter((rate) => rate.worse).map((rate) => `${rate.what} of ${rate.subject} in ${rate.family}`),
    ...baseline.changed_times.map((time) => `${time.slower ? "slower" : "faster"}: ${time.subject} in ${time.family}, ${time.kind}, ${time.ratio.toFixed(2)} times`)];
  for (const name of ["before.db", "now.db", "report"]) rmSync(join(folder, name), { recursive: true });
  return found;
}

/** Counts the pairs with an alarm that is `right`, and prints the other alarms. */
function count(what, subjects, defect, seed, right = () => true) {
  let noticed = 0;
  let wrong = 0;
  for (let pair = 0; pair < Number(pairs); ++pair) {
    night("before", seed + 2 * pair, subjects, {});
    night("now", seed + 2 * pair + 1, subjects, defect);
    const found = alarms();
    const others = found.filter((each) => !right(each));
    noticed += found.length > others.length ? 1 : 0;
    wrong += others.length > 0 ? 1 : 0;
    if (others.length > 0) console.log(`  seeds ${seed + 2 * pair} and ${seed + 2 * pair + 1}: ${others.join("; ")}`);
  }
  console.log(`${what}: ${noticed} right and ${wrong} false alarms in ${pairs} pairs of ${cases}${length[0] === "--cases" ? " cases" : ""}`);
}

try {
  execFileSync(resolve(nearmiss), ["--version"]);
  if (!only || only === "equal") count("equal campaigns of wang, basic, basic-plain", "wang,basic,basic-plain", {}, 1, () => false);
  for (const [i, subject] of ["wang", "basic"].entries())
    if (!only || only === subject)
      count(`a defect of one in 3,000 planted in ${subject}`, planted(subject), { NEARMISS_PLANTED: "3000" }, 1001 * (i + 1), (each) => !/^(slower|faster)/.test(each));
  if (!only || only === "slower") {
    const subjects = `wang,basic,${planted("wang")}`;
    count("equal campaigns of wang, basic and a plug-in", subjects, {}, 5001, () => false);
    count("the family kilometres of a plug-in 1.5 times slower", subjects, { NEARMISS_SLOWED: "1.5" }, 7001, (each) => /^slower: planted-in-wang in kilometres/.test(each));
  }
} finally {
  rmSync(folder, { recursive: true });
}
