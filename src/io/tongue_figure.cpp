#include "strutt/io/tongue_figure.hpp"

#include "io/figure_file.hpp"
#include "io/tongue_script.hpp"

namespace strutt {

struct TongueFigure::State : FigureFile {
  using FigureFile::FigureFile;
};

TongueFigure::TongueFigure(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

TongueFigure::~TongueFigure() = default;

void TongueFigure::draw(const TongueFigureContent& content) {
  const GnuplotRun gnuplot;
  gnuplot.write(kCurvesFile, tongue_curve_data(content));
  state_->draw(gnuplot, tongue_script(content, state_->format()));
}

}  // namespace strutt
