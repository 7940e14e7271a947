#include "strutt/io/portrait_figure.hpp"

#include "io/figure_file.hpp"
#include "io/portrait_script.hpp"

namespace strutt {

struct PortraitFigure::State : FigureFile {
  using FigureFile::FigureFile;
};

PortraitFigure::PortraitFigure(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

PortraitFigure::~PortraitFigure() = default;

void PortraitFigure::draw(const std::vector<PhaseCurve>& curves, const PortraitDescription& description) {
  const GnuplotRun gnuplot;
  for (int k = 0; k < kCurveKindCount; ++k) {
    const auto kind = static_cast<CurveKind>(k);
    gnuplot.write(portrait_file(kind), portrait_data(curves, kind));
  }
  gnuplot.write(kArrowsFile, arrow_data(curves, description));
  state_->draw(gnuplot, portrait_script(curves, description, state_->format()));
}

}  // namespace strutt
