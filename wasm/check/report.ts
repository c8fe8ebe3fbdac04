// What a check found, as the report "dualblock-check/1" and in a few lines for people.
import { version } from '../../package.json';
import type { CoreError } from '../result.ts';
import type { CheckResult } from './check.ts';
import { checkNames } from './findings.ts';
import { describeShape } from './shape.ts';
import type { TargetSettings } from './target.ts';

export const checkFormat = 'dualblock-check/1';

/** The names of the files, or of a built-in example. */
export interface CheckedNames {
  mesh: string;
  domain: string | null;
}

/** A check's result as a plain object, ready for JSON. */
export function makeCheckReport(
  result: CheckResult,
  dimension: 2 | 3,
  names: CheckedNames,
  settings: TargetSettings,
) {
  const { findings, counts, shape, measure, geometry, target, comparison } = result;
  return {
    format: checkFormat,
    version,
    settings,
    mesh: { name: names.mesh, dimension, ...counts, ...(shape ?? {}), measure, ...geometry },
    domain: target && {
      name: names.domain,
      vertices: target.solid.domain.vertices.length,
      facets: target.solid.domain.facets.length,
      patches: target.patches.length,
      ridges: target.ridges.length,
      corners: target.corners.length,
      interfaces: target.patches.filter(({ isInterface }) => isInterface).length,
      ...target.solid.shape,
    },
    comparison,
    checks: findings.verdicts,
    valid: findings.valid,
    failures: findings.failures,
    failureCounts: Object.fromEntries(checkNames.map((name) => [name, findings.count(name)])),
    notes: findings.notes,
  };
}
export type CheckReport = ReturnType<typeof makeCheckReport>;

/** The report of a check that an error in a file ended. */
export function makeCheckErrorReport(names: CheckedNames, settings: TargetSettings, error: CoreError) {
  return {
    format: checkFormat,
    version,
    settings,
    mesh: { name: names.mesh },
    domain: { name: names.domain },
    error,
  };
}

/** The report in a few lines. */
export function describeCheck(report: CheckReport): string {
  const { mesh, domain, comparison, checks, failures, failureCounts, notes } = report;
  const flat = mesh.dimension === 2;
  const measure = flat ? 'area' : 'volume';
  const { euler, components, shells, decided, minScaledJacobian } = mesh;
  const names = checkNames.filter((name) => checks[name] !== null);
  const lines = [
    `${mesh.name}: ${mesh.blocks} blocks (${flat ? 'quadrilaterals' : 'hexahedra'}), ${mesh.nodes} nodes, ${mesh.edges} edges`,
    euler !== undefined && components !== undefined && shells !== undefined
      ? `  ${describeShape({ euler, components, shells })}`
      : '',
    `  positive everywhere: ${decided.doubles + decided.exact + decided.halving} blocks${howDecided(decided, mesh.depth)}`,
    `  scaled Jacobian: minimum ${minScaledJacobian?.toPrecision(3) ?? 'none'}; ${measure}: ${mesh.measure}`,
    domain
      ? `  against ${domain.name}: ${domain.patches} ${flat ? 'sides' : 'planes'}, ${domain.corners} corners`
      : '',
    comparison ? describeComparison(comparison, measure, checks.measure === null) : '',
    ...notes.map((note) => `  note: ${note}`),
    `  ${report.valid ? 'valid' : 'NOT VALID'}: ${names.map((name) => (checks[name] ? name : `${name} FAILED`)).join(', ')}`,
    ...checkNames.flatMap((name) => {
      const kept = failures.filter(({ check }) => check === name);
      const more = (failureCounts[name] ?? 0) - kept.length;
      return [
        ...kept.map(({ message }) => `    ${name}: ${message}`),
        ...(more > 0 ? [`    ${name}: and ${more} more`] : []),
      ];
    }),
  ];
  return lines.filter((line) => line !== '').join('\n');
}

function howDecided({ exact, halving }: CheckReport['mesh']['decided'], depth: number): string {
  const ways = [
    ...(exact > 0 ? [`${exact} by exact arithmetic`] : []),
    ...(halving > 0 ? [`${halving} by up to ${depth} halving(s)`] : []),
  ];
  return ways.length > 0 ? `, of them ${ways.join(', ')}` : '';
}

function describeComparison(
  { difference, largestDistance, fidelity }: NonNullable<CheckReport['comparison']>,
  measure: string,
  isApproximate: boolean,
): string {
  const how = isApproximate ? '  curved surface, approximated: ' : '  ';
  const off = `${how}${measure} differs by ${difference.toPrecision(3)}, boundary nodes are off by at most ${largestDistance.toPrecision(3)}`;
  if (!fidelity || fidelity.largestDistance + fidelity.largestTurning === 0) return off; // or not measured
  return `${off}\n  faces and edges stand for what is off by up to ${fidelity.largestDistance.toPrecision(2)} of their size, and turns by up to ${fidelity.largestTurning.toFixed(0)} degrees`;
}
