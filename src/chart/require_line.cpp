#include "chart/require_line.hpp"

#include <cmath>

#include "strutt/base/error.hpp"

namespace strutt {

void require_line(const Scene& scene, const TongueLine& line) {
  require(std::isfinite(line.from) && std::isfinite(line.to), line.parameter, line.to - line.from,
          "a finite range");
  require(line.from < line.to, line.parameter + ": TO", line.to, "above FROM = " + to_text(line.from));
  Scene changed = scene;
  for (const double end : {line.from, line.to}) {
    parameter(changed, line.parameter) = end;
    validate(changed);
  }
}

}  // namespace strutt
