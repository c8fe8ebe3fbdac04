// Generated from core/base/error_codes.def by core/toolchain/generate-error-codes.mjs: do not edit.

/** Every error code, in the order of the C++ enum, with its meaning. */
export const errorCodes = [
  { name: 'fileUnreadable', meaning: 'the file cannot be opened or read' },
  { name: 'fileEmpty', meaning: 'the file holds nothing' },
  { name: 'formatUnknown', meaning: 'no reader knows this file type' },
  { name: 'syntax', meaning: 'the file breaks the grammar of its format' },
  { name: 'versionUnknown', meaning: "the format's version is not one this program reads" },
  { name: 'fileTruncated', meaning: 'the file ends before everything it announces' },
  { name: 'notFinite', meaning: 'a coordinate is not a finite number' },
  { name: 'scaleExtreme', meaning: 'the domain is too large or too small to reckon with' },
  { name: 'indexOutOfRange', meaning: 'a reference names an entity that does not exist' },
  { name: 'tooFewVertices', meaning: 'a domain needs more vertices' },
  { name: 'tooFewFacets', meaning: 'a domain needs more facets' },
  { name: 'degenerateFacet', meaning: 'a facet has no area, or a segment no length' },
  { name: 'duplicateFacet', meaning: 'two facets are the same' },
  { name: 'nonPlanarFacet', meaning: 'a facet is not planar within the tolerance' },
  { name: 'openBoundary', meaning: 'the boundary is not closed' },
  { name: 'selfIntersection', meaning: 'the boundary crosses or touches itself' },
  { name: 'holeOutside', meaning: 'a hole lies outside the domain or touches its boundary' },
  { name: 'regionOutside', meaning: "a region's point lies outside the domain" },
  { name: 'emptyDomain', meaning: 'the domain encloses nothing' },
  { name: 'referenceInvalid', meaning: 'the given reference mesh does not fill the domain' },
  { name: 'tetgenFailed', meaning: 'TetGen could not fill the domain' },
  { name: 'outOfMemory', meaning: 'not enough memory' },
  { name: 'timeLimit', meaning: 'the run took longer than it was allowed to' },
  { name: 'contributionInvalid', meaning: 'a given contribution names no proper subset of its simplex' },
  { name: 'noValidMesh', meaning: 'no block mesh of this domain passed the certificate' },
  { name: 'badOption', meaning: 'an option has a value that it cannot have' },
  { name: 'nothingLoaded', meaning: 'run was called before a domain was loaded' },
  { name: 'libraryMissing', meaning: 'a library that a file format needs cannot be loaded' },
  { name: 'internal', meaning: 'a defect in dualblock' },
] as const;

export type ErrorCode = (typeof errorCodes)[number]['name'];
