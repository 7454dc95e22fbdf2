#include "io/seal.hpp"

#include <fmt/format.h>

#include <fstream>
#include <span>
#include <stdexcept>

#include "io/atomic_file.hpp"
#include "math/error.hpp"
#include "math/hash.hpp"

namespace packbed {
namespace {

constexpr std::size_t kSealLength = 64;  // fixed, so that the seal is found from the end
constexpr std::string_view kSealMark = "\npackbed ";

std::string seal_of(std::string_view bytes, std::string_view kind) {
  Hash hash;
  hash.add(std::as_bytes(std::span(bytes.data(), bytes.size())));
  std::string seal = fmt::format("{}{} 1 {} {}", kSealMark, kind, bytes.size(), hash.hex());
  if (seal.size() >= kSealLength) throw std::logic_error("seal longer than its place");
  seal.resize(kSealLength - 1, ' ');
  return seal + '\n';
}

}  // namespace

std::string sealed(std::string_view bytes, std::string_view kind) {
  return std::string(bytes) + seal_of(bytes, kind);
}

std::string unsealed_file(const std::string& path, std::string_view kind) {
  std::string content = read_file(path);
  const std::string allowed = fmt::format("a whole {} file as packbed wrote it", kind);
  if (content.empty()) throw InputError(path, "an empty file", allowed);
  if (content.size() < kSealLength) throw InputError(path, fmt::format("{} bytes", content.size()), allowed);
  const std::string seal = content.substr(content.size() - kSealLength);
  content.resize(content.size() - kSealLength);
  if (!seal.starts_with(kSealMark))
    throw InputError(path, "a file that is cut, or of another program (it does not end with packbed's seal)",
                     allowed, "take an undamaged copy, or run the case again");
  if (!seal.starts_with(fmt::format("{}{} ", kSealMark, kind)))
    throw InputError(
        path,
        fmt::format("a packbed file of another kind ({})",
                    seal.substr(kSealMark.size(), seal.find(' ', kSealMark.size()) - kSealMark.size())),
        allowed);
  if (seal != seal_of(content, kind))
    throw InputError(path, "a file that was changed after it was written (its hash does not fit)", allowed,
                     "take an undamaged copy, or run the case again");
  return content;
}

bool is_sealed_as(const std::string& path, std::string_view kind) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() < static_cast<std::streamoff>(kSealLength)) return false;
  file.seekg(-static_cast<std::streamoff>(kSealLength), std::ios::end);
  std::string seal(kSealLength, '\0');
  file.read(seal.data(), static_cast<std::streamsize>(seal.size()));
  return file && seal.starts_with(fmt::format("{}{} ", kSealMark, kind));
}

}  // namespace packbed
