#include "io/figure_file.hpp"

#include "io/text.hpp"

namespace strutt {
namespace {

const std::filesystem::path& with_gnuplot(const std::filesystem::path& figure) {
  require_gnuplot(figure);
  return figure;
}

}  // namespace

FigureFile::FigureFile(const std::filesystem::path& path)
    : path_(path), format_(figure_format(path)), file_(with_gnuplot(path)) {}

void FigureFile::draw(const GnuplotRun& gnuplot, std::string_view script) {
  gnuplot.write("figure.gp", script);
  gnuplot.run("figure.gp", path_);
  file_.write(read_file(gnuplot / kPictureFile, kLargestPicture));
  file_.commit();
}

}  // namespace strutt
