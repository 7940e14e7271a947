#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace strutt {

/// A result file that is never half written: bytes go to a temporary file beside the target; commit()
/// flushes, fsyncs and renames it over the target. Destruction without commit() removes the temporary and
/// leaves an old target as it was. A target that exists and is not a regular file (/dev/full, a FIFO,
/// /dev/stdout) is written directly. Every failing call throws InputOutputError naming the target. Opened
/// (and so probed) on construction.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(OutputFile&&) noexcept;
  OutputFile(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void write_at(std::uint64_t offset, std::string_view bytes);  ///< regular files only
  void
  prepare();  ///< all of commit() but the renaming: call it on every file of a set before the first commit()
  void commit();

  /// The path where bytes go until commit(): for libraries that open files by name.
  const std::filesystem::path& path() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace strutt
