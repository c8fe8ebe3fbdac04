import { readFileSync } from 'node:fs';

const root = new URL('../../../', import.meta.url);

/** A file of the repository. */
export const repositoryFile = (path: string): Buffer => readFileSync(new URL(path, root));
