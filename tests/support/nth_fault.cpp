// Preloaded into bench: the n-th call of one kind, counted over a run and its child processes,
// fails.
//
//   AIRYBENCH_FAULT=write:7   the kind (open, read, write, fsync, rename, send, recv, fork, alloc)
//                             and which call of it; allocations from main() on, of the program and
//                             its libraries; hang: a fork that does not return
//   AIRYBENCH_FAULT_TOLD=FILE is made when it has failed
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

std::atomic<long>* calls = nullptr;  // shared with the children
char kind[16] = "";
long failing = 0;
bool in_main = false;
int (*main_of_program)(int, char**, char**) = nullptr;

__attribute__((constructor)) void begin() {
  const char* const fault = std::getenv("AIRYBENCH_FAULT");
  const char* const colon = fault == nullptr ? nullptr : std::strchr(fault, ':');
  if (colon == nullptr || static_cast<std::size_t>(colon - fault) >= sizeof kind) return;
  std::memcpy(kind, fault, static_cast<std::size_t>(colon - fault));
  failing = std::atol(colon + 1);
  void* const shared =
      mmap(nullptr, sizeof *calls, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  calls = new (shared) std::atomic<long>(0);
}

bool fails(const char* call, int error) {
  if (calls == nullptr || std::strcmp(kind, call) != 0 || ++*calls != failing) return false;
  const long told =
      syscall(SYS_openat, AT_FDCWD, std::getenv("AIRYBENCH_FAULT_TOLD"), O_CREAT | O_WRONLY, 0666);
  syscall(SYS_close, told);
  errno = error;
  return true;
}

bool allocation_fails() { return in_main && fails("alloc", ENOMEM); }

int main_with_faults(int argc, char** argv, char** environment) {
  in_main = true;
  return main_of_program(argc, argv, environment);
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  if (fails("open", EMFILE)) return -1;
  return real<int(const char*, int, ...)>("open")(path, flags, mode);
}
ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (fails("write", ENOSPC)) return -1;
  return real<ssize_t(int, const void*, size_t)>("write")(descriptor, bytes, count);
}
ssize_t read(int descriptor, void* bytes, size_t count) {
  if (fails("read", EIO)) return -1;
  return real<ssize_t(int, void*, size_t)>("read")(descriptor, bytes, count);
}
int fsync(int descriptor) {
  if (fails("fsync", EIO)) return -1;
  return real<int(int)>("fsync")(descriptor);
}
int rename(const char* from, const char* to) noexcept {
  if (fails("rename", ENOSPC)) return -1;
  return real<int(const char*, const char*)>("rename")(from, to);
}
ssize_t send(int socket, const void* bytes, size_t count, int flags) {
  if (fails("send", ENOBUFS)) return -1;
  return real<ssize_t(int, const void*, size_t, int)>("send")(socket, bytes, count, flags);
}
ssize_t recv(int socket, void* bytes, size_t count, int flags) {
  if (fails("recv", EIO)) return -1;
  return real<ssize_t(int, void*, size_t, int)>("recv")(socket, bytes, count, flags);
}
pid_t fork() noexcept {
  if (fails("fork", EAGAIN)) return -1;
  if (fails("hang", 0))
    for (;;) pause();
  return real<pid_t()>("fork")();
}

// What the heap probe takes for the C library's own.
void* __libc_malloc(size_t bytes) {
  static const auto next = real<void*(size_t)>("__libc_malloc");
  return allocation_fails() ? nullptr : next(bytes);
}
void* __libc_calloc(size_t count, size_t bytes) {
  static const auto next = real<void*(size_t, size_t)>("__libc_calloc");
  return allocation_fails() ? nullptr : next(count, bytes);
}
void* __libc_realloc(void* block, size_t bytes) {
  static const auto next = real<void*(void*, size_t)>("__libc_realloc");
  return allocation_fails() ? nullptr : next(block, bytes);
}
void* __libc_memalign(size_t alignment, size_t bytes) {
  static const auto next = real<void*(size_t, size_t)>("__libc_memalign");
  return allocation_fails() ? nullptr : next(alignment, bytes);
}

int __libc_start_main(int (*program)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*loader_fini)(), void* stack_end) {
  main_of_program = program;
  using Start =
      int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  return real<Start>("__libc_start_main")(main_with_faults, argc, argv, init, fini, loader_fini,
                                          stack_end);
}

}  // extern "C"
