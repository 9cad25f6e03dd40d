// The steps that look for a defect, in order, until one finds it.
import path from 'node:path';
import { run } from './copy.mjs';

const queries = (line) => Number(line.trim().split(' ').at(-1));

/** The hunter: a disagreement about a query of a family. */
async function hunt(copy, most) {
  const { output } = await run(path.join(copy.build, 'tests/judge/judge_hunter'), most ? [String(most)] : [], copy);
  const line = output.trim().split('\n').find((each) => /^(found|nothing) /.test(each));
  if (!line) throw new Error(`the hunter says '${output}'`);
  if (line.startsWith('nothing')) return undefined;
  const [, what, query] = /^found (.*) (\S+) \d+$/.exec(line);
  return { what, query, queries: queries(line) };
}

/** GoogleTest: the first test that fails. */
const tests = (name) => async (copy) => {
  const { code, output } = await run(path.join(copy.build, 'tests', name), ['--gtest_fail_fast', '--gtest_brief=1'],
    { cwd: copy.build, seconds: 900 });
  if (code === 0) return undefined;
  return { what: /\[ {2}FAILED {2}\] (\S+)/.exec(output)?.[1].replace(/,$/, '') ?? `${name} ended` };
};

/** CTest: the first test that fails, among those whose names match. */
const ctest = (pattern) => async (copy) => {
  const { code, output } = await run('ctest', ['-R', pattern, '--stop-on-failure'], { cwd: copy.build });
  if (output.includes('No tests were found')) throw new Error(`no test is called ${pattern}`);
  if (code === 0) return undefined;
  return { what: /Test +#\d+: (\S+)/g.exec(output.split('\n').find((line) => line.includes('***')) ?? '')?.[1] ?? pattern };
};

export const steps = [
  { name: 'hunter', target: 'judge_hunter', find: hunt },
  { name: 'tests', target: 'oracle_tests', find: tests('oracle_tests') },
  { name: 'proofs', target: 'proofs_tests', find: ctest('[Pp]roofs') },
];
