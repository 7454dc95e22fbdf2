// packbed-cad-reader: reads one CAD or mesh file and writes a CadMessage to its standard output. A program of
// its own because gmsh, OpenCASCADE and assimp crash on bad files, take the memory that a header asks for,
// and cost 70 MB to load: none of that is packbed's.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <exception>
#include <new>

#include "io/cad_reader/readers.hpp"
#include "mesh/repair.hpp"

#ifdef PACKBED_SANITIZED
// The shadow of a sanitizer needs more address space than any limit; it has limits of its own
extern "C" const char* __asan_default_options() {
  return "hard_rss_limit_mb=2048:detect_leaks=0:abort_on_error=1";
}
extern "C" const char* __tsan_default_options() {
  return "memory_limit_mb=2048:report_bugs=0";
}
#endif

namespace packbed {
namespace {

void set_limits(const CadRequest& request) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no packbed, nobody to answer
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const auto seconds = static_cast<rlim_t>(std::ceil(request.seconds));
  const rlimit time{seconds, seconds};
  ::setrlimit(RLIMIT_CPU, &time);
#ifndef PACKBED_SANITIZED
  const auto bytes = static_cast<rlim_t>(request.memory);
  const rlimit memory{bytes, bytes};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

constexpr const char* kNoMemory = "a file that needs more memory than the reader may use";

bool write_all(int to, const std::vector<std::byte>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(to, bytes.data() + done, bytes.size() - done);
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

// Made while there is memory: gmsh lets bad_alloc escape from places where it ends the program.
std::vector<std::byte> no_memory_answer;
int answer_to = -1;

[[noreturn]] void say_no_memory() {
  ::_exit(write_all(answer_to, no_memory_answer) ? 0 : 3);
}

CadMessage read(const CadRequest& request) {
  if (request.format == "STEP") return read_step(request);
  CadMessage out = request.format == "MSH" ? read_msh(request) : read_triangles(request);
  if (!request.want_tets || out.tets) return out;
  TriangleMesh whole = out.mesh;
  for (const auto& t : whole.triangles)
    for (const std::int32_t v : t)
      if (v < 0 || static_cast<std::size_t>(v) >= whole.vertices.size()) return out;
  for (const Vec3& v : whole.vertices)
    if (!v.allFinite()) return out;  // packbed's own checks say what is wrong
  weld(whole);
  out.tets = fill_with_tets(whole, request.tet_size);
  return out;
}

CadMessage read_or_say_why(const CadRequest& request) {
  CadMessage failed;
  try {
    return read(request);
  } catch (const std::bad_alloc&) {
    failed.error = kNoMemory;
  } catch (const std::exception& e) {
    failed.error = e.what();
  } catch (const std::string& e) {  // gmsh
    failed.error = e;
  } catch (...) {
    failed.error = "the CAD library failed";
  }
  if (failed.error.empty()) failed.error = "the CAD library failed";
  return failed;
}

}  // namespace
}  // namespace packbed

int main(int argc, char** argv) {
  using namespace packbed;
  const auto request = CadRequest::from_arguments({argv + 1, static_cast<std::size_t>(argc - 1)});
  if (!request) return 2;
  // OpenCASCADE talks on standard output
  answer_to = ::dup(1);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (answer_to < 0 || nowhere < 0 || ::dup2(nowhere, 1) < 0) return 3;
  CadMessage no_memory;
  no_memory.error = kNoMemory;
  no_memory_answer = encode(no_memory);
  std::set_new_handler(say_no_memory);
  set_limits(*request);
  const bool written = write_all(answer_to, encode(read_or_say_why(*request)));
  ::_exit(written ? 0 : 3);  // the libraries' own endings may crash or hang
}
