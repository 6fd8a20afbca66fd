// Compiled into sanitized programs: what LeakSanitizer must not blame on us. Gmsh and the
// OpenCASCADE inside it keep global objects until the end.
extern "C" const char* __lsan_default_suppressions() { return "leak:libgmsh\nleak:libTK\n"; }
// Standard error is the program's own; and while it reads a model it may start no program, so not
// the symbolizer either.
extern "C" const char* __lsan_default_options() { return "print_suppressions=0:symbolize=0"; }
