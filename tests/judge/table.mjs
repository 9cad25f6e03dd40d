// Formats the results of run.mjs as a table.
import { steps } from './steps.mjs';

const median = (numbers) => [...numbers].sort((a, b) => a - b)[Math.floor((numbers.length - 1) / 2)];

/** A text table: columns are as wide as they need to be. */
function columns(rows) {
  const widths = rows[0].map((_, i) => Math.max(...rows.map((row) => String(row[i]).length)));
  return rows.map((row) => row.map((cell, i) => String(cell).padEnd(widths[i])).join('  ').trimEnd()).join('\n');
}

/** Whether no step found a defect: after all steps have looked for it, or (isOpen) after only some have. */
const isMissed = (result) => result?.by === 'nothing' && steps.every(({ name }) => result.asked.includes(name));
const isOpen = (result) => result?.by === 'nothing' && !isMissed(result);

/** Defects that contradict the list: found in spite of a reason, not found without one, or not compiled. */
export function unexpected(defects, results) {
  return defects.filter(({ name, reason }) => {
    const result = results[name];
    if (!result || isOpen(result)) return false;
    return result.by === 'compiler' || isMissed(result) !== (reason !== '');
  });
}

function byGroup(defects, results) {
  const rows = [['group', 'defects', 'hunter', 'median queries', 'largest', 'tests', 'proofs', 'nothing', 'not yet', 'not asked']];
  for (const group of [...new Set(defects.map((defect) => defect.group)), undefined]) {
    const own = defects.filter((defect) => !group || defect.group === group).map(({ name }) => results[name]);
    const count = (by) => own.filter((result) => result?.by === by).length;
    const queries = own.filter((result) => result?.by === 'hunter').map((result) => result.queries);
    rows.push([group ?? 'all', own.length, count('hunter'), median(queries) ?? '',
      queries.length > 0 ? Math.max(...queries) : '', count('tests'), count('proofs'),
      own.filter(isMissed).length, own.filter(isOpen).length, own.filter((result) => !result).length]);
  }
  return columns(rows);
}

/** The text of the table: a row for each group, then a row for each defect. */
export function table(defects, results) {
  const rows = [['defect', 'found by', 'what', 'query', 'queries', 'seconds']];
  for (const { name } of defects) {
    const { by = '', what = '', query = '', queries = '', seconds = '' } = results[name] ?? {};
    rows.push([name, isOpen(results[name]) ? `not by ${results[name].asked.join(', ')}` : by, what, query, queries, seconds]);
  }
  const strange = unexpected(defects, results);
  const list = strange.map(({ name, about }) => `${name} (${results[name].by}): ${about}`);
  const reasons = defects.filter(({ name, reason }) => reason && isMissed(results[name]));
  return [
    byGroup(defects, results), columns(rows),
    'Not found, and why:', ...reasons.map(({ name, reason }) => `${name}: ${reason}`),
    'Not as the list says:', ...list,
  ].join('\n\n') + '\n';
}
