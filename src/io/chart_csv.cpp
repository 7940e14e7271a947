#include "io/chart_writers.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/output_file.hpp"

namespace strutt {
namespace {

class CsvWriter : public ChartWriter {
 public:
  CsvWriter(const std::filesystem::path& path, const ChartDescription& description)
      : file_(path), request_(description.request), order_(description.request) {
    for (const Layer layer : request_.layers) names_.push_back(category_names(layer));
    for (const double x : axis_values(request_.x)) x_texts_.push_back(to_text(x) + ",");
    file_.write(head(description));
  }

  void write(const ChartStrip& strip) override {
    order_.take(strip);
    for (std::size_t j = 0; j < strip.rows; ++j) write_row(strip, j);
  }

  void conclude(const Provenance& done) override { file_.write(comment_lines(done)); }

  void prepare() override {
    order_.finish();
    file_.prepare();
  }

  void commit() override {
    prepare();
    file_.commit();
  }

 private:
  static std::string head(const ChartDescription& description) {
    const ChartRequest& request = description.request;
    std::string units = "# units: " + unit_of(description.x) + "," + unit_of(description.y);
    std::string names = request.x.parameter + "," + request.y.parameter;
    for (const Layer layer : request.layers) {
      units += "," + std::string(unit_of(layer));
      names += "," + std::string(to_string(layer));
    }
    return comment_lines(description.provenance) + units + "\n" + names + "\n";
  }

  void write_row(const ChartStrip& strip, std::size_t j) {
    const std::string y = to_text(request_.y.value(strip.first_row + j));
    row_.clear();
    for (std::size_t i = 0; i < strip.columns; ++i) {
      row_ += x_texts_[i];
      row_ += y;
      for (std::size_t l = 0; l < names_.size(); ++l) {
        row_ += ',';
        add_cell(l, strip.values[l][j * strip.columns + i]);
      }
      row_ += '\n';
    }
    file_.write(row_);
  }

  void add_cell(std::size_t layer, double value) {
    if (names_[layer].empty())
      row_ += to_text(value);
    else
      row_ += names_[layer].at(static_cast<std::size_t>(category_value(value)));
  }

  OutputFile file_;
  ChartRequest request_;
  StripOrder order_;
  std::vector<std::vector<std::string>> names_;  // of the categories of each layer, empty for real ones
  std::vector<std::string> x_texts_;
  std::string row_;
};

}  // namespace

std::unique_ptr<ChartWriter> make_csv_writer(const std::filesystem::path& path,
                                             const ChartDescription& description) {
  return std::make_unique<CsvWriter>(path, description);
}

}  // namespace strutt
