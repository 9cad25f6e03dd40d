// Makes a copy of the tree in which defects can be made: its oracle is a copy, everything else links to the
// tree.
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { applied, filesOf, here } from './list.mjs';

export const source = path.resolve(here, '../..');

/** The files of a folder and of those in it, with their paths from `root`, in a fixed order. */
export function filesBelow(root, folder) {
  return readdirSync(path.join(root, folder), { withFileTypes: true })
    .sort((a, b) => (a.name < b.name ? -1 : 1))
    .flatMap((entry) => {
      const name = path.join(folder, entry.name);
      return entry.isDirectory() ? filesBelow(root, name) : [name];
    });
}

/** Runs a command at low priority. Returns its exit code (null if it was killed) and all that it printed. */
export function run(command, args, { cwd, env = {}, seconds = 1800 }) {
  return new Promise((resolve) => {
    const child = spawn('nice', ['-n', '2', command, ...args], { cwd, env: { ...process.env, ...env } });
    let output = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => (output += data));
    const timer = setTimeout(() => child.kill('SIGKILL'), 1000 * seconds);
    child.on('close', (code) => {
      clearTimeout(timer);
      resolve({ code, output });
    });
  });
}

/** The folders that a defect may alter: the oracle, and fuzz/, which makes subjects of it. */
export const alterable = ['oracle', 'fuzz'];

/** A copy of the tree, with a build folder of its own. */
export class Copy {
  constructor(folder) {
    this.folder = folder;
    this.build = path.join(folder, 'build/release');
  }

  /** Makes the copy, or restores its oracle; configures the build once. */
  async prepare() {
    for (const folder of alterable) mkdirSync(path.join(this.folder, folder), { recursive: true });
    for (const name of readdirSync(source)) {
      const link = path.join(this.folder, name);
      if (['.git', 'build', ...alterable].includes(name) || existsSync(link)) continue;
      symlinkSync(path.join(source, name), link);
    }
    const names = alterable.flatMap((folder) => filesBelow(source, folder));
    for (const name of alterable.flatMap((folder) => filesBelow(this.folder, folder)))
      if (!names.includes(name)) rmSync(path.join(this.folder, name));
    for (const name of names) this.#write(name, readFileSync(path.join(source, name), 'utf8'));
    if (existsSync(path.join(this.build, 'build.ninja'))) return;
    const quick = [`-DCMAKE_PROJECT_nearmiss_INCLUDE=${path.join(source, 'tools/cmake/judge_copies.cmake')}`];
    const { code, output } = await run('cmake', ['--preset', 'release', ...quick], { cwd: this.folder });
    if (code !== 0) throw new Error(`${this.folder}: cmake failed\n${output}`);
  }

  /** Makes a defect in the copy, calls `work`, and undoes the defect. */
  async with(defect, work) {
    const originals = filesOf(defect).map((file) => [file, readFileSync(path.join(source, file), 'utf8')]);
    for (const [file, text] of originals) this.#write(file, applied(defect, file, text));
    this.altered = true;
    try {
      return await work();
    } finally {
      for (const [file, text] of originals) this.#write(file, text);
    }
  }

  /** Builds a target; returns the compiler's output if that fails, else nothing. */
  async make(target) {
    // A defect is compiled only once, so a compiler cache is of no use, and with precompiled headers it is
    // slower than the compiler.
    const env = this.altered ? { CCACHE_DISABLE: '1' } : { CCACHE_BASEDIR: this.folder, CCACHE_NOHASHDIR: '1' };
    const { code, output } = await run('ninja', ['-j1', '-C', this.build, target], { cwd: this.folder, env });
    return code === 0 ? undefined : output;
  }

  /** Whether the build knows a target. */
  async knows(target) {
    const { code } = await run('ninja', ['-C', this.build, '-t', 'query', target], { cwd: this.folder });
    return code === 0;
  }

  #write(name, text) {
    const file = path.join(this.folder, name);
    mkdirSync(path.dirname(file), { recursive: true });
    if (!existsSync(file) || readFileSync(file, 'utf8') !== text) writeFileSync(file, text);
  }
}
