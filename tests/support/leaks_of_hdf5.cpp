// Compiled into sanitized tests: what LeakSanitizer must not blame on us. HDF5 keeps some of what
// it has read of a damaged file.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
