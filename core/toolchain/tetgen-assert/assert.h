// Stands in for the C library's assert.h where tetgen.h is read, which includes it after anything we could
// define: TetGen's asserts throw its own code for an internal error, in its header's inline functions too.
// Read again and again, like the one that it stands in for.
#undef assert
#define assert(condition) ((condition) ? static_cast<void>(0) : throw 2)
