// Cells as faces and outlines. Only faces that can be seen are drawn: those without a visible neighbour.
import {
  BufferAttribute,
  BufferGeometry,
  type DataTexture,
  DynamicDrawUsage,
  FrontSide,
  Group,
  LineSegments,
  Mesh,
  type ShaderMaterial,
  Vector4,
} from 'three';
import { type CellSet, cellCenters, type Plane } from '../display/cell-set.ts';
import type { EntityKind } from '../state/view-state.ts';
import { type Cap, capsOf } from './caps.ts';
import { cellMaterial } from './cell-material.ts';
import { Facing } from './facing.ts';
import { Layer, pointTexture, putPoints } from './layer.ts';

export interface CellLayerOptions {
  kind: EntityKind;
  /** Number for picking, over 0. */
  number: number;
  faces?: boolean;
  outlines?: boolean;
  /** 0: colours as they are; 1: lit. */
  lit?: number;
  /** How much darker outlines are than their cell: 0 to 1. */
  lineTint?: number;
}

/** Points of sections' outlines from which on they would hide the sections. */
const mostCapLines = 80_000;

export class CellLayer extends Layer {
  readonly object = new Group();
  readonly set: CellSet;
  private readonly faces: Mesh<BufferGeometry, ShaderMaterial> | null = null;
  private readonly outlines: LineSegments<BufferGeometry, ShaderMaterial> | null = null;
  private readonly caps: Mesh<BufferGeometry, ShaderMaterial> | null = null;
  private readonly capLines: LineSegments<BufferGeometry, ShaderMaterial> | null = null;
  private readonly exposed: Uint8Array;
  private mask: Uint8Array | null = null;
  private closed: Cap | null = null;
  /** Of a boundary: another layer shows what filters lay open behind it. */
  isShell = false;
  /** Of many cells only faces towards the eye are given to the renderer. */
  private turns = false;
  /** Null until they are looked at. */
  private facing: Facing | null = null;
  private readonly eye = new Vector4();

  constructor(set: CellSet, options: CellLayerOptions) {
    const { kind, number, faces = true, outlines = true, lit = 1, lineTint = 0.72 } = options;
    super(kind, number, set.centers);
    this.set = set;
    this.uniforms.centers.value = pointTexture(set.centers);
    this.exposed = new Uint8Array(set.faceCell.length);
    const position = new BufferAttribute(set.points, 3);
    const cell = new BufferAttribute(Float32Array.from(set.pointCell), 1);
    if (faces) {
      this.faces = new Mesh(
        indexed(position, cell, triangleCount(set) * 3),
        cellMaterial(this.uniforms, { lit, wired: outlines ? set.wired : null, wireTint: lineTint }),
      );
      this.caps = new Mesh(new BufferGeometry(), cellMaterial(this.uniforms, { lit: 0, cap: true }));
      this.capLines = new LineSegments(
        new BufferGeometry(),
        cellMaterial(this.uniforms, { lineTint, cap: true }),
      );
      this.caps.visible = this.capLines.visible = false;
      this.object.add(this.faces, this.caps, this.capLines);
    }
    if (outlines && set.lines.length > 0) {
      this.outlines = new LineSegments(
        indexed(position, cell, set.lines.length),
        cellMaterial(this.uniforms, { lineTint }),
      );
      this.object.add(this.outlines);
    }
    for (const child of this.object.children) child.frustumCulled = false;
    if (!set.open && this.faces) this.faces.material.side = FrontSide;
    this.show(null, false);
  }

  show(mask: Uint8Array | null, gaps: boolean): void {
    const { set, exposed } = this;
    this.mask = mask;
    for (let f = 0; f < exposed.length; f++) {
      const other = set.faceOther[f]!;
      const visible = mask === null || mask[set.faceCell[f]!] !== 0;
      const isBare = mask !== null && !this.isShell && (other < 0 || mask[other] === 0);
      const open = other === -1 || isBare;
      exposed[f] = visible && (gaps || open) ? 1 : 0;
    }
    if (this.faces) this.fill(this.faces.geometry, (out) => triangles(set, exposed, out));
    this.facing = null;
    this.turns = set.wired !== null && !set.open && !gaps; // with gaps cells are elsewhere
    if (this.outlines) this.fill(this.outlines.geometry, (out) => outlines(set, exposed, gaps, out));
  }

  /** Before it is drawn: what it is looked at from, homogeneous. */
  lookFrom(eye: Vector4): void {
    const { faces, set } = this;
    if (!faces || !this.turns || (this.facing && eye.equals(this.eye))) return;
    const facing = this.facing ?? new Facing(set.points, indices(faces.geometry));
    this.facing = facing;
    this.eye.copy(eye);
    this.fill(faces.geometry, (out) => facing.towards(eye, out));
  }

  /** Moves the cells' points, xyz each; to be shown anew. */
  move(points: Float32Array): void {
    const { set } = this;
    set.points.set(points);
    set.centers.set(cellCenters(set.count, set.points, set.pointCell));
    const centers = this.uniforms.centers.value as DataTexture;
    putPoints(set.centers, centers.image.data as unknown as Float32Array);
    centers.needsUpdate = true;
    for (const mesh of [this.faces, this.outlines]) {
      const position = mesh?.geometry.getAttribute('position');
      if (position) position.needsUpdate = true;
    }
  }

  /** Closes the cells that the planes cut; none removes the caps. */
  cap(planes: readonly Plane[]): void {
    if (!this.caps || !this.capLines) return;
    this.caps.visible = this.capLines.visible = planes.length > 0;
    this.closed = null;
    if (planes.length === 0) return;
    const { shrink, explode, origin } = this.uniforms;
    const deform = { shrink: shrink.value, explode: explode.value, origin: origin.value.toArray() };
    const cap = capsOf(this.set, this.mask, planes, deform);
    this.closed = cap;
    for (const [mesh, index] of [
      [this.caps, cap.index],
      [this.capLines, cap.lines],
    ] as const) {
      mesh.geometry.dispose();
      mesh.geometry = capGeometry(cap, index);
    }
    this.capLines.visible = cap.lines.length < mostCapLines;
  }

  /** Outlines the sections of two layers, or of neither. */
  outlineLike({ capLines: other }: CellLayer): void {
    const { capLines: own } = this;
    if (own && other) own.visible = other.visible = own.visible && other.visible;
  }

  /** Triangles, outlines and what closes cut cells as they may be seen now, from wherever, for export. */
  drawn(): {
    points: Float32Array;
    cell: Int32Array;
    triangles: Uint32Array;
    lines: Uint32Array;
    caps: Cap | null;
  } {
    const used = (geometry: BufferGeometry | undefined): Uint32Array =>
      geometry ? indices(geometry) : new Uint32Array();
    return {
      points: this.set.points,
      cell: this.set.pointCell,
      triangles: this.facing?.triangles ?? used(this.faces?.geometry),
      lines: this.set.wired ? loops(this.set, this.exposed) : used(this.outlines?.geometry),
      caps: this.closed,
    };
  }

  override dispose(): void {
    for (const object of [this.faces, this.outlines, this.caps, this.capLines]) {
      object?.geometry.dispose();
      object?.material.dispose();
    }
    super.dispose();
    this.uniforms.centers.value?.dispose();
  }

  private fill(geometry: BufferGeometry, write: (out: Uint32Array) => number): void {
    const index = geometry.index!;
    const used = write(index.array as Uint32Array);
    geometry.setDrawRange(0, used);
    index.clearUpdateRanges();
    index.addUpdateRange(0, used);
    index.needsUpdate = true;
  }
}

function indexed(position: BufferAttribute, cell: BufferAttribute, most: number): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', position);
  geometry.setAttribute('cell', cell);
  const index = new BufferAttribute(new Uint32Array(most), 1);
  index.setUsage(DynamicDrawUsage);
  geometry.setIndex(index);
  return geometry;
}

/** A copy of the indices that are drawn. */
function indices({ index, drawRange }: BufferGeometry): Uint32Array {
  return (index!.array as Uint32Array).slice(0, drawRange.count);
}

function triangleCount({ faceOffsets, faceCell }: CellSet): number {
  return faceOffsets[faceCell.length]! - 2 * faceCell.length;
}

function triangles({ faceOffsets, facePoints }: CellSet, exposed: Uint8Array, out: Uint32Array): number {
  let n = 0;
  for (let f = 0; f < exposed.length; f++) {
    if (!exposed[f]) continue;
    const from = faceOffsets[f]!;
    for (let k = from + 1; k + 1 < faceOffsets[f + 1]!; k++) {
      out[n++] = facePoints[from]!;
      out[n++] = facePoints[k]!;
      out[n++] = facePoints[k + 1]!;
    }
  }
  return n;
}

/** Each edge of each face, once per face. */
function loops({ faceOffsets, facePoints }: CellSet, exposed: Uint8Array): Uint32Array {
  const out: number[] = [];
  for (let f = 0; f < exposed.length; f++) {
    if (!exposed[f]) continue;
    const from = faceOffsets[f]!;
    const to = faceOffsets[f + 1]!;
    for (let k = from; k < to; k++) out.push(facePoints[k]!, facePoints[k + 1 < to ? k + 1 : from]!);
  }
  return Uint32Array.from(out);
}

/** Where cells touch, a line of several of them is drawn once: by the first that shows it. */
function outlines(
  { lines, lineFaces, lineTwin }: CellSet,
  exposed: Uint8Array,
  gaps: boolean,
  out: Uint32Array,
): number {
  const seen = (line: number): boolean => {
    const second = lineFaces[2 * line + 1]!;
    return exposed[lineFaces[2 * line]!] === 1 || (second >= 0 && exposed[second] === 1);
  };
  let n = 0;
  for (let k = 0; k < lineTwin.length; k++) {
    if (!seen(k)) continue;
    let twin = gaps ? -1 : lineTwin[k]!;
    while (twin >= 0 && !seen(twin)) twin = lineTwin[twin]!;
    if (twin >= 0) continue;
    out[n++] = lines[2 * k]!;
    out[n++] = lines[2 * k + 1]!;
  }
  return n;
}

function capGeometry({ points, cell }: Cap, index: Uint32Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(points, 3));
  geometry.setAttribute('cell', new BufferAttribute(cell, 1));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}
