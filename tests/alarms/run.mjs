// Counts how often a report with a baseline raises an alarm. Each campaign is compared with two others. One
// differs only in its seed, so that every alarm is false. The other also has a planted defect: one wrong
// answer in 3,000 queries, by a subject without failures or by one that already fails; or a family that takes
// 1.5 times as long. CASES is a number of cases, or a time such as 20s. The counts so far are printed after
// every ten pairs.
//
//     node tests/alarms/run.mjs [--jobs N] NEARMISS PLUGINS [PAIRS [CASES [equal|wang|basic|slower]]]
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, renameSync, rmSync } from "node:fs";
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
  rmSync(join(folder, `${name}.db`), { force: true });
  const { status, stderr } = spawnSync(resolve(nearmiss),
    ["fuzz", ...length, "--seed", `${seed}`, "--subject", subjects, "--db", `${name}.db`],
    { cwd: folder, env: { ...process.env, ...defect }, encoding: "utf8" });
  if (status !== 0 && status !== 1) throw new Error(`fuzz ended with ${status}: ${stderr}`);
}

/**
 * What the report says about changes since the baseline: ways to fail that are new or gone, worse rates, and
 * changed run times.
 */
function alarms() {
  spawnSync(resolve(nearmiss), ["report", "now.db", "--baseline", "before.db", "-o", "report"], { cwd: folder });
  const { baseline } = JSON.parse(readFileSync(join(folder, "report", "report.json")));
  const found = [...baseline.new_signatures.map((each) => `${each.what} of ${each.subject}, ${each.signature}`),
    ...baseline.gone_signatures.map((each) => `no ${each.what} of ${each.subject}, ${each.signature}`),
    ...baseline.changed_rates.filter((rate) => rate.worse).map((rate) => `${rate.what} of ${rate.subject} in ${rate.family}`),
    ...baseline.changed_times.map((time) => `${time.slower ? "slower" : "faster"}: ${time.subject} in ${time.family}, ${time.kind}, ${time.ratio.toFixed(2)} times`)];
  rmSync(join(folder, "report"), { recursive: true });
  return found;
}

/**
 * Counts the right and the false alarms of pairs of campaigns. `right` says whether an alarm is right; the
 * others are printed.
 */
class Count {
  constructor(what, right) {
    Object.assign(this, { what, right, pairs: 0, noticed: 0, wrong: 0 });
  }

  compare(seeds) {
    const found = alarms();
    const others = found.filter((each) => !this.right(each));
    this.pairs += 1;
    this.noticed += found.length > others.length ? 1 : 0;
    this.wrong += others.length > 0 ? 1 : 0;
    if (others.length > 0) console.log(`  seeds ${seeds}: ${others.join("; ")}`);
  }

  print() {
    console.log(`${this.what}: ${this.noticed} right and ${this.wrong} false alarms in ${this.pairs} pairs of ${cases}${length[0] === "--cases" ? " cases" : ""}`);
  }
}

/**
 * Compares each campaign with the next one, which differs only in its seed, and, if there is a defect, with
 * one that has it.
 */
function count(what, subjects, seed, defect, right) {
  const equal = new Count(`equal campaigns of ${subjects.replaceAll(/[^,]*\/(planted[^,]*)\.so/g, "$1")}`, () => false);
  const changed = new Count(what, right);
  night("before", seed, subjects, {});
  for (let pair = 1; pair <= Number(pairs); ++pair) {
    if (defect) {
      night("now", seed + 2 * pair + 1, subjects, defect);
      changed.compare(`${seed + 2 * pair - 2} and ${seed + 2 * pair + 1}`);
    }
    night("now", seed + 2 * pair, subjects, {});
    equal.compare(`${seed + 2 * pair - 2} and ${seed + 2 * pair}`);
    renameSync(join(folder, "now.db"), join(folder, "before.db"));
    if (pair % 10 === 0 || pair === Number(pairs)) for (const each of defect ? [equal, changed] : [equal]) each.print();
  }
}

try {
  execFileSync(resolve(nearmiss), ["--version"]);
  if (!only || only === "equal") count("", "wang,basic,basic-plain", 1);
  for (const [i, subject] of ["wang", "basic"].entries())
    if (!only || only === subject)
      count(`a defect of one in 3,000 planted in ${subject}`, planted(subject), 1001 * (i + 1), { NEARMISS_PLANTED: "3000" },
        (each) => !/^(slower|faster)/.test(each));
  if (!only || only === "slower")
    count("the family kilometres of a plug-in 1.5 times slower", `wang,basic,${planted("wang")}`, 5001, { NEARMISS_SLOWED: "1.5" },
      (each) => /^slower: planted-in-wang in kilometres/.test(each));
} finally {
  rmSync(folder, { recursive: true });
}
