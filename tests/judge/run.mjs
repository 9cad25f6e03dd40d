// Tries to find every listed defect.
// Usage: run.mjs [--jobs N] [--only REGEX] [--every N] [--again] [--queries N] [--steps hunter,...]
//
// Results are saved after every defect, so that the same command resumes where it stopped; --again repeats
// the hunt for defects that nothing found. build/judge/results.json and table.txt say what found each defect,
// and how soon. Exit code 1 means that a defect was found although the list gives a reason why it cannot be
// found, or that a defect without such a reason was not found.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { Copy, filesBelow, source } from './copy.mjs';
import { readOptions } from '../../tools/options.mjs';
import { filesOf, readDefects } from './list.mjs';
import { steps } from './steps.mjs';
import { table, unexpected } from './table.mjs';

const { options } = readOptions({
  jobs: { type: 'string', default: '2' },
  only: { type: 'string', default: '' },
  every: { type: 'string', default: '1' },
  queries: { type: 'string' },
  steps: { type: 'string', default: steps.map(({ name }) => name).join() },
  again: { type: 'boolean', default: false },
});
const folder = path.join(source, 'build/judge');
const store = path.join(folder, 'results.json');
const defects = readDefects();
const wanted = steps.filter(({ name }) => options.steps.split(',').includes(name));

/**
 * A digest of the sources for which a result is valid: the oracle, and the files of fuzz/ that make subjects
 * of it.
 */
const oracle = createHash('sha256');
const extra = ['contract', 'exact'].map((name) => `fuzz/subjects/${name}.cpp`);
for (const name of [...filesBelow(source, 'oracle'), ...extra]) oracle.update(readFileSync(path.join(source, name)));
const sources = oracle.digest('hex');
const keyOf = ({ places }) =>
  createHash('sha256').update(JSON.stringify([places, sources])).digest('hex').slice(0, 16);

const results = existsSync(store) ? JSON.parse(readFileSync(store, 'utf8')) : {};

function save() {
  writeFileSync(store, JSON.stringify(results, null, 1));
  writeFileSync(path.join(folder, 'table.txt'), table(defects, results));
}

/** The first step that finds something wrong in the copy in its present state. */
async function look(copy) {
  const asked = [];
  for (const step of wanted) {
    if (!(await copy.knows(step.target))) continue;
    const complaint = await copy.make(step.target);
    if (complaint) return { by: 'compiler', what: /error: (.*)/.exec(complaint)?.[1] ?? complaint, asked };
    asked.push(step.name);
    const found = await step.find(copy, options.queries);
    if (found) return { by: step.name, ...found, asked };
  }
  return { by: 'nothing', asked };
}

async function work(copy, queue) {
  for (let defect = queue.shift(); defect; defect = queue.shift()) {
    const start = Date.now();
    const result = await copy.with(defect, () => look(copy));
    results[defect.name] = { ...result, seconds: Math.round((Date.now() - start) / 1000), key: keyOf(defect) };
    save();
    console.log(`${defect.name}: ${result.by} ${result.what ?? ''} ${result.query ?? ''} ${result.queries ?? ''}`);
  }
}

mkdirSync(folder, { recursive: true });
const chosen = defects.filter((defect) => new RegExp(options.only).test(`${defect.name} in ${filesOf(defect)}`))
  .filter((_, number) => number % Number(options.every) === 0);
const queue = chosen.filter((defect) => {
  const known = results[defect.name];
  if (known?.key !== keyOf(defect) || known.by === 'compiler') return true;
  return known.by === 'nothing' && (options.again || wanted.some(({ name }) => !known.asked.includes(name)));
});
console.log(`${queue.length} of ${defects.length} defects to look for`);
const copies = Array.from({ length: Number(options.jobs) }, (_, i) => new Copy(path.join(folder, String(i + 1))));
for (const copy of queue.length > 0 ? copies : []) await copy.prepare();
if (queue.length > 0 && !options.only) {
  const sound = await look(copies[0]);
  if (sound.by !== 'nothing') throw new Error(`the unaltered oracle: ${JSON.stringify(sound)}`);
  console.log('nothing is found in the unaltered oracle');
}
await Promise.all(copies.map((copy) => work(copy, queue)));
save();
console.log(`see ${path.join(folder, 'table.txt')}`);
process.exitCode = unexpected(defects, results).length > 0 ? 1 : 0;
