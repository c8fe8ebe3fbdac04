// A CGNS file: a tree of nodes in HDF5, which NIST's package h5wasm writes.
import type { Group } from 'h5wasm';
import { DualblockError } from './errors.ts';

type Hdf5 = typeof import('h5wasm');
export type Values = Float64Array | Float32Array | Int32Array | Int8Array;

export interface CgnsNode {
  /**
   * A child. Names are ASCII, at most `kLongestName` characters, without "/", and each once per parent. The shape of a
   * value of several dimensions is the reverse of CGNS' own: there the first index runs fastest, in HDF5 the last.
   */
  add(name: string, label: string, value?: Values, shape?: number[]): CgnsNode;
}

export const kLongestName = 32;

/** The size of a name or label: a zero ends it. */
const kName = kLongestName + 1;

/**
 * The bytes of a file of version 3.3 with the nodes that `build` adds to its root; the same nodes give the same bytes.
 * Throws `libraryMissing` if the HDF5 library cannot be loaded.
 */
export async function cgnsFile(build: (root: CgnsNode) => void): Promise<Uint8Array<ArrayBuffer>> {
  const hdf5 = await loadHdf5();
  const path = '/mesh.cgns'; // in the library's own memory
  const { FS } = hdf5;
  try {
    withClockAt(0, () => {
      // The versions of HDF5 that libcgns asks for: nothing newer than what its readers know.
      const file = new hdf5.File(path, 'w', { track_order: true, libver: ['v108', 'v110'] });
      try {
        addAttributes(hdf5, file, 'HDF5 MotherNode', 'Root Node of HDF5 File', 'MT');
        file.create_dataset({ name: ' format', data: ascii('IEEE_LITTLE_32\0') });
        file.create_dataset({ name: ' hdf5version', data: ascii('HDF5 Version 1.10.8'.padEnd(kName, '\0')) });
        const root = nodeOf(hdf5, file);
        root.add('CGNSLibraryVersion', 'CGNSLibraryVersion_t', Float32Array.of(3.3));
        build(root);
      } finally {
        file.close();
      }
    });
    return FS!.readFile(path) as Uint8Array<ArrayBuffer>;
  } finally {
    if (FS!.analyzePath(path).exists) FS!.unlink(path);
  }
}

/** About 1 MB, so only once it is needed. */
async function loadHdf5(): Promise<Hdf5> {
  try {
    const hdf5 = await import('h5wasm');
    await hdf5.ready;
    return hdf5;
  } catch (error) {
    throw new DualblockError(
      'libraryMissing',
      'CGNS files need the HDF5 library, which cannot be loaded: go online and load the page anew or, on the ' +
        `command line, run npm ci in dualblock's folder (${(error as Error).message})`,
    );
  }
}

/** HDF5 notes the time at every object, and the library has no option that leaves it out. */
function withClockAt(time: number, task: () => void): void {
  const { now } = Date;
  Date.now = () => time;
  try {
    task();
  } finally {
    Date.now = now;
  }
}

/** An HDF5 group that says in attributes what it is, with its value in a dataset, as a CGNS node. */
function nodeOf(hdf5: Hdf5, parent: Group): CgnsNode {
  return {
    add(name, label, value, shape) {
      const group = parent.create_group(name, true); // its children keep their order
      addAttributes(hdf5, group, name, label, value ? typeOf(value) : 'MT');
      group.create_attribute('flags', Int32Array.of(1), [1], '<i');
      if (value) group.create_dataset({ name: ' data', data: value, shape: shape ?? [value.length] });
      return nodeOf(hdf5, group);
    },
  };
}

function typeOf(value: Values): string {
  if (value instanceof Float64Array) return 'R8';
  if (value instanceof Float32Array) return 'R4';
  return value instanceof Int32Array ? 'I4' : 'C1';
}

function addAttributes(hdf5: Hdf5, group: Group, name: string, label: string, type: string): void {
  addString(hdf5, group, 'name', name, kName);
  addString(hdf5, group, 'label', label, kName);
  addString(hdf5, group, 'type', type, 3); // libcgns reads it into three bytes, however long it is
}

/** ASCII that a zero ends, as libcgns writes it; what h5wasm makes of strings is UTF-8 that blanks fill up. */
function addString({ Module }: Hdf5, group: Group, name: string, value: string, size: number): void {
  const bytes = new Uint8Array(size);
  bytes.set(ascii(value));
  const at = Module._malloc(size);
  try {
    Module.HEAPU8.set(bytes, Number(at));
    Module.create_attribute(group.file_id, group.path, name, BigInt(at), {
      type: Module.H5T_class_t.H5T_STRING.value,
      size,
      total_size: size,
      cset: 0,
      vlen: false,
      signed: false,
      littleEndian: true,
      shape: [],
      maxshape: [],
    });
  } finally {
    Module._free(at);
  }
}

/** As CGNS has text: without a zero behind it. */
export const ascii = (text: string): Int8Array => Int8Array.from(text, (c) => c.charCodeAt(0));
