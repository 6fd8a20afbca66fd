#!/bin/sh
# shared_symbols.sh OBJECT: fails, and prints them, if an object compiled for one instruction set
# has weak symbols that other objects may have too: the linker would keep one of them for all.
set -eu
symbols=$(nm --demangle "$1")
if printf '%s\n' "$symbols" | grep -E '^[0-9a-f]+ [VWu] ' | grep -v 'airybench::Pack<'; then
  exit 1
fi
printf '%s\n' "$symbols" | grep -q 'hybrid_kernels_'
