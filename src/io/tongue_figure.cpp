#include "strutt/io/tongue_figure.hpp"

#include "io/gnuplot.hpp"
#include "io/text.hpp"
#include "io/tongue_script.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {

struct TongueFigure::State {
  explicit State(const std::filesystem::path& path) : target(path), format(figure_format(path)), file(path) {}

  std::filesystem::path target;
  FigureFormat format;
  OutputFile file;
};

TongueFigure::TongueFigure(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}

TongueFigure::~TongueFigure() = default;

void TongueFigure::draw(const TongueFigureContent& content) {
  const GnuplotRun gnuplot;
  gnuplot.write(kCurvesFile, tongue_curve_data(content));
  gnuplot.write("tongues.gp", tongue_script(content, state_->format));
  gnuplot.run("tongues.gp", state_->target);
  state_->file.write(read_file(gnuplot / kPictureFile, kLargestPicture));
  state_->file.commit();
}

}  // namespace strutt
