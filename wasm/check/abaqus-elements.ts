// Abaqus's elements, as far as a block mesh may hold them.

export interface AbaqusElement {
  dimension: number;
  nodes: number;
  isBlock: boolean;
}

const element = (dimension: number, nodes: number, isBlock = false): AbaqusElement => ({
  dimension,
  nodes,
  isBlock,
});

/**
 * Families by their names up to what follows the number of nodes: letters for reduced integration, hybrid elements, heat
 * and the like. Elements of CalculiX have the same names. In a mesh in 3D all but hexahedra are left out.
 */
const kFamilies: [RegExp, AbaqusElement][] = [
  [/^(?:C|DC|DCC|AC|QC|EMC)3D8[A-Z]*$|^SC8R[A-Z]*$|^CSS8$|^COH3D8[A-Z]*$/, element(3, 8, true)],
  [
    /^(?:CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|EMC2D|M3D|SFM3D|R3D|DS)4[A-Z]*$|^S4(?:R|RS|RSW|R5|T|RT)?$/,
    element(2, 4, true),
  ],
  [
    /^(?:CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|EMC2D|M3D|SFM3D|R3D|DS)3[A-Z]*$|^S3(?:R|RS|T|RT)?$|^STRI3$/,
    element(2, 3),
  ],
  [/^(?:CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|M3D|SFM3D)6[A-Z]*$|^STRI65$/, element(2, 6)],
  [/^(?:CPS|CPE|CPEG|CAX|CGAX|DC2D|DCAX|AC2D|ACAX|M3D|SFM3D|DS)8[A-Z]*$|^S8R(?:5|T)?$/, element(2, 8)],
  [
    /^(?:T2D2|T3D2|B21|B31|B23|B33|PIPE21|PIPE31)[A-Z]*$|^(?:R2D2|RAX2|SAX1|DC1D2|AC1D2|CONN[23]D2)$/,
    element(1, 2),
  ],
  [/^(?:SPRINGA|SPRING2|DASHPOTA|DASHPOT2|GAPUNI|FRAME[23]D)$/, element(1, 2)],
  [/^(?:T2D3|T3D3|B22|B32|PIPE22|PIPE32)[A-Z]*$|^(?:SAX2|DC1D3|AC1D3)$/, element(1, 3)],
  [/^(?:MASS|ROTARYI|SPRING1|DASHPOT1|HEATCAP)$/, element(0, 1)],
];

/** What an element type is; undefined for one that is not known, or that no block mesh may hold. */
export const abaqusElement = (type: string): AbaqusElement | undefined =>
  kFamilies.find(([names]) => names.test(type.toUpperCase()))?.[1];
