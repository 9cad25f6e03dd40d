// Compares operations of Lanes with those of double, lane by lane. lanes_test.sh builds this program for each
// instruction set. Exit code 1 means that an operation differs.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "ccd/query/lanes.hpp"

namespace nearmiss {
namespace {

bool differs = false;

template <int n>
class Operations {
  using Real = Lanes<n>;
  using Numbers = std::array<double, n>;
  /// A truth value that is the same in all lanes.
  struct Truths {
    bool same;
    bool operator[](std::size_t /*lane*/) const { return same; }
  };

 public:
  void run() {
    for (int i = 0; i < 1000; ++i) {
      const Numbers x = numbers();
      const Numbers y = numbers();
      const Real a = Real::gather([&](std::size_t lane) { return x[lane]; });
      const Real b = Real::gather([&](std::size_t lane) { return y[lane]; });
      const auto compare = [&](const char* what, const auto& lanes, const auto& of_double) {
        for (std::size_t lane = 0; lane < n; ++lane)
          if (static_cast<double>(lanes[lane]) != static_cast<double>(of_double(x[lane], y[lane])))
            report(what);
      };
      compare("a", a, [](double p, double) { return p; });
      compare("a + b", a + b, [](double p, double q) { return p + q; });
      compare("-a * b", -a * b, [](double p, double q) { return -p * q; });
      compare("|a|", abs(a), [](double p, double) { return std::abs(p); });
      compare("the sign of |0|", Real(1) / abs(a * Real(0)), [](double, double) { return HUGE_VAL; });
      compare("sqrt", sqrt(abs(a)), [](double p, double) { return std::sqrt(std::abs(p)); });
      compare("min", min(a, b), [](double p, double q) { return std::min(p, q); });
      compare("max", max(a, b), [](double p, double q) { return std::max(p, q); });
      compare("a < b", a < b, [](double p, double q) { return p < q; });
      compare("a <= b", a <= b, [](double p, double q) { return p <= q; });
      compare("a == b", a == b, [](double p, double q) { return p == q; });
      compare("&", (a < b) & (a > 0), [](double p, double q) { return p < q && p > 0; });
      compare("|", (a < b) | (a > 0), [](double p, double q) { return p < q || p > 0; });
      compare("!", !(a < b), [](double p, double q) { return !(p < q); });
      compare("any_of", Truths{any_of(a < b)}, [&](double, double) {
        bool any = false;
        for (std::size_t lane = 0; lane < n; ++lane) any = any || x[lane] < y[lane];
        return any;
      });
      compare("select", select(a < b, a, b), [](double p, double q) { return p < q ? p : q; });
      compare("a / b", a / select(b == 0, Real(1), b),
              [](double p, double q) { return p / (q == 0 ? 1 : q); });
    }
    std::array<Numbers, n> rows;
    for (Numbers& row : rows) row = numbers();
    std::array<Real, n> columns;
    for (std::size_t row = 0; row < n; ++row) columns[row] = Real::load(rows[row].data());
    Real::transpose(columns.data());
    for (std::size_t row = 0; row < n; ++row)
      for (std::size_t column = 0; column < n; ++column)
        if (columns[column][row] != rows[row][column]) report("transpose");
  }

 private:
  Numbers numbers() {
    Numbers made;
    for (double& each : made)
      each = (static_cast<int>(random_() % 9) - 4) / 3.0;  // some numbers are equal, and some are 0
    return made;
  }
  static void report(const char* what) {
    std::printf("%d lanes: %s\n", n, what);
    differs = true;
  }

  std::mt19937 random_{1};
};

}  // namespace
}  // namespace nearmiss

int main() {
#if defined(__AVX512F__)
  nearmiss::Operations<8>().run();
#elif defined(__AVX2__)
  nearmiss::Operations<4>().run();
#else
  nearmiss::Operations<2>().run();
#endif
  return nearmiss::differs ? 1 : 0;
}
