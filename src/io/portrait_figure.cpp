#include "strutt/io/portrait_figure.hpp"

#include "io/gnuplot.hpp"
#include "io/portrait_script.hpp"
#include "io/text.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {

struct PortraitFigure::State {
  explicit State(const std::filesystem::path& path) : target(path), format(figure_format(path)), file(path) {}

  std::filesystem::path target;
  FigureFormat format;
  OutputFile file;
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
  gnuplot.write("portrait.gp", portrait_script(curves, description, state_->format));
  gnuplot.run("portrait.gp", state_->target);
  state_->file.write(read_file(gnuplot / kPictureFile, kLargestPicture));
  state_->file.commit();
}

}  // namespace strutt
