#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace strutt {

/// Throws InputOutputError naming `figure` unless the program gnuplot is in the PATH: to be asked before a
/// long computation.
void require_gnuplot(const std::filesystem::path& figure);

/// A text as gnuplot's single-quoted string: no escapes and no command substitution inside.
std::string gnuplot_string(std::string_view text);

/// A directory for the script and its data, gone with the object.
class GnuplotRun {
 public:
  /// Throws InputOutputError if there is no place for temporary files.
  GnuplotRun();
  ~GnuplotRun();
  GnuplotRun(const GnuplotRun&) = delete;
  GnuplotRun& operator=(const GnuplotRun&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return directory_ / name; }
  void write(std::string_view name, std::string_view bytes) const;

  /// Runs gnuplot on the file `script` of the directory, as its working directory. Throws InputOutputError
  /// naming `figure` when gnuplot is missing or complains.
  void run(const std::string& script, const std::filesystem::path& figure) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace strutt
