#pragma once

#include <filesystem>
#include <string_view>

#include "io/figure_format.hpp"
#include "io/gnuplot.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {

/// The file of a picture that gnuplot draws: opened (and so probed) before anything is computed, there under
/// its name only once it is complete.
class FigureFile {
 public:
  /// Throws InvalidInput for an ending that is no kind of picture, InputOutputError without gnuplot or if the
  /// file cannot be made.
  explicit FigureFile(const std::filesystem::path& path);

  FigureFormat format() const { return format_; }

  /// Runs `script`, which writes kPictureFile, on the files of the directory and moves the picture into
  /// place.
  void draw(const GnuplotRun& gnuplot, std::string_view script);

 private:
  std::filesystem::path path_;
  FigureFormat format_;
  OutputFile file_;
};

}  // namespace strutt
