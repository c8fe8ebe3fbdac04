/** What was done to the D̄-surfaces of the primal. */
export function changesText(mesh: {
  extracted: ArrayLike<number>;
  inserted: number;
  doubled: number;
}): string {
  const changes: string[] = [];
  if (mesh.doubled > 0)
    changes.push(`${mesh.doubled} D̄-surface(s) doubled so that blocks follow the bent sides`);
  if (mesh.extracted.length > 0 || mesh.inserted > 0)
    changes.push(`${mesh.extracted.length} D̄-surface(s) extracted, ${mesh.inserted} inserted`);
  return changes.join(', ');
}
