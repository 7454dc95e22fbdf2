#pragma once
// Runs a command of the shell, or the program as a user does.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace packbed {

struct Ran {
  int code = -1;
  std::string output;  // both streams
};

inline Ran run_command(const std::string& command) {
  Ran ran;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    ran.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) ran.code = WEXITSTATUS(status);
  return ran;
}

inline Ran run_program(const std::string& words) {
  return run_command("'" PACKBED_PROGRAM "' " + words);
}

}  // namespace packbed
