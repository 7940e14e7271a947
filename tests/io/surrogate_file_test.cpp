#include "strutt/io/surrogate_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "io/scratch.hpp"
#include "strutt/base/error.hpp"
#include "strutt/io/scene_file.hpp"
#include "strutt/io/table.hpp"

namespace strutt::test::surrogate_file_test {

namespace {

Surrogate mathieu_surrogate() {
  const Scene scene = parse_scene("[mathieu]\nepsilon = 0.5\ndamping = 0.1\n", "scene").scene;
  return {
      scene,
      {.parameter = "mathieu.delta", .from = 0.1, .to = 6.0, .points = 100, .scale = AxisScale::logarithmic},
      {.parameter = "mathieu.epsilon", .from = 0.0, .to = 6.0, .points = 100},
      {.tolerance = 1e-8}};
}

}  // namespace

TEST_CASE("a surrogate that was saved is the same to the bit", "[io][surrogate]") {
  const test::ScratchDirectory directory;
  const auto path = directory / "mathieu.json";
  const Surrogate saved = mathieu_surrogate();
  save_surrogate(path, saved, make_provenance("strutt test"));
  const Surrogate loaded = load_surrogate(path);
  CHECK(loaded.kind() == saved.kind());
  CHECK(loaded.even_phase() == saved.even_phase());
  CHECK(loaded.data().tolerance == 1e-8);
  CHECK(loaded.data().x.scale == AxisScale::logarithmic);
  CHECK(loaded.report().largest_check == saved.report().largest_check);
  REQUIRE(loaded.boxes().size() == saved.boxes().size());
  for (std::size_t b = 0; b < saved.boxes().size(); ++b) {
    CHECK(loaded.boxes()[b].coefficients == saved.boxes()[b].coefficients);
    CHECK(loaded.boxes()[b].error == saved.boxes()[b].error);
  }
  for (const double delta : {0.1, 0.7, 6.0}) {
    const auto a = saved.monodromy(delta, 2.5), b = loaded.monodromy(delta, 2.5);
    REQUIRE((a && b));
    CHECK(a->matrix.value.mantissa == b->matrix.value.mantissa);
    CHECK(a->error == b->error);
  }
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK_THAT(text, Catch::Matchers::Contains("strutt test"));
}

TEST_CASE("a file that is no surrogate is refused", "[io][surrogate]") {
  const test::ScratchDirectory directory;
  CHECK_THROWS_AS(load_surrogate(directory / "missing.json"), InputOutputError);
  const auto path = directory / "other.json";
  const auto refused = [&](const std::string& text) {
    std::ofstream(path) << text;
    CHECK_THROWS_AS(load_surrogate(path), FileError);
  };
  refused("");
  refused("{\"format\": \"strutt surrogate\", \"version\": 2}");
  save_surrogate(path, mathieu_surrogate(), {});
  std::ifstream file(path);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  file.close();
  refused(whole.substr(0, whole.size() / 2));
  std::string other = whole;  // one row of coefficients more than the others have
  other.replace(other.find("\"coefficients\":[[["), 18, "\"coefficients\":[[[1.0],[");
  refused(other);
}

}  // namespace strutt::test::surrogate_file_test
