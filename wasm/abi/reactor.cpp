// The translation unit of the wasm executables. All that it exports (handlebody.h) is in the library that it links; the linker
// takes what the export list names and drops the rest.
