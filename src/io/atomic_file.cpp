#include "io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "math/error.hpp"

namespace packbed {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& doing, int cause) {
  std::string advice;
  if (cause == ENOSPC || cause == EDQUOT) advice = ". Fix: free space or write elsewhere (--out)";
  if (cause == EACCES || cause == EPERM || cause == EROFS)
    advice = ". Fix: make the folder writable or write elsewhere (--out)";
  throw SystemError(fmt::format("{}: {} failed: {}{}", path, doing, std::strerror(cause), advice));
}

class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

/// Some file systems cannot sync (EINVAL, ENOTSUP); there is nothing to be done then.
bool synced(int fd) {
  return ::fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP;
}

void sync_file(const std::string& temporary, const std::string& path) {
  const Descriptor file(temporary, O_RDONLY);
  if (file.get() < 0) fail(path, "writing", errno);
  if (!synced(file.get())) fail(path, "writing to disk", errno);
}

void sync_folder(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  const Descriptor descriptor(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
  // the file itself is on disk and in place: a folder that cannot be opened or synced is no reason to fail
  if (descriptor.get() >= 0) synced(descriptor.get());
}

void write_all(const std::string& temporary, const std::string& path, std::string_view content) {
  const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
  if (file.get() < 0) fail(path, "writing", errno);
  while (!content.empty()) {
    const ssize_t n = ::write(file.get(), content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "writing", errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace

void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write) {
  const std::string temporary = fmt::format("{}.{}.tmp", path, ::getpid());
  try {
    write(temporary);
    sync_file(temporary, path);
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "renaming", errno);
  } catch (const InputError&) {
    ::unlink(temporary.c_str());
    throw;
  } catch (const SystemError&) {
    ::unlink(temporary.c_str());
    throw;
  } catch (const std::exception& e) {
    ::unlink(temporary.c_str());
    throw SystemError(fmt::format("{}: writing failed: {}", path, e.what()));
  }
  sync_folder(path);
}

void write_atomically(const std::string& path, std::string_view content) {
  write_atomically(path, [&](const std::string& temporary) { write_all(temporary, path, content); });
}

std::string read_file(const std::string& path) {
  const Descriptor file(path, O_RDONLY);
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    throw InputError(path, std::strerror(errno), "a file that can be read");
  if (S_ISDIR(status.st_mode)) throw InputError(path, "a folder", "a file");
  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size));
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(file.get(), buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw SystemError(fmt::format("{}: reading failed: {}", path, std::strerror(errno)));
    if (n == 0) return content;
    content.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace packbed
