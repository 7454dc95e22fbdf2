#pragma once
// Files that are either whole or not there: written under a temporary name in the same folder, synced,
// renamed.
#include <functional>
#include <string>
#include <string_view>

namespace packbed {

/// Calls write(temporary_path), which must create and close that file; then syncs it, renames it to `path`
/// and syncs the folder. On any failure the temporary file is removed and `path` is as it was before. Throws
/// SystemError naming path and cause (no space, no permission, ...); InputError of `write` passes through.
void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write);

/// The same for a text or a blob that is at hand.
void write_atomically(const std::string& path, std::string_view content);

/// The whole file. Throws InputError when it is missing or a folder, SystemError when reading fails.
std::string read_file(const std::string& path);

}  // namespace packbed
