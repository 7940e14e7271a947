#include "io/figure_format.hpp"

#include "io/file_ending.hpp"
#include "io/text.hpp"
#include "strutt/base/error.hpp"

namespace strutt {

FigureFormat figure_format(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".png") return FigureFormat::png;
  if (ending == ".svg") return FigureFormat::svg;
  if (ending == ".pdf") return FigureFormat::pdf;
  throw InvalidInput("the format of '" + printable(path.string()) +
                     "' is not known: a figure ends with .png, .svg or .pdf");
}

std::string gnuplot_terminal(FigureFormat format) {
  switch (format) {
    case FigureFormat::svg:
      return "svg size 1600,1100 enhanced font 'DejaVu Sans,20' background '#FFFFFF' linewidth 2";
    case FigureFormat::pdf:
      return "pdfcairo size 8in,5.5in enhanced font 'DejaVu Sans,8' linewidth 1";
    case FigureFormat::png:
      break;
  }
  return "pngcairo size 1600,1100 enhanced font 'DejaVu Sans,20' linewidth 2";
}

}  // namespace strutt
