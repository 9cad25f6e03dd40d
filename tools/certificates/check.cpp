#include "tools/certificates/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <valarray>

using Json = nlohmann::json;
// The JSON library looks for this function in the namespace of mpq_class. The library calls the function to
// read fractions, including those in arrays.
static void from_json(const Json& from, mpq_class& to);

namespace certificates {
namespace {
using Rationals = std::vector<mpq_class>;
using Integers = std::valarray<mpz_class>;
constexpr std::string_view digits = "0123456789";

void demand(bool holds, const char* otherwise) {
  if (!holds) throw Refused(otherwise);
}

double exact_double(const mpq_class& value) {
  const double same = value.get_d();
  demand(std::isfinite(same) && value == same, "a number that should be a finite double");
  return same;
}

/// Removes characters from the front of `rest`, up to the first character that is not in `characters`.
/// Returns the removed characters.
std::string_view take(std::string_view& rest, std::string_view characters) {
  const std::string_view taken = rest.substr(0, rest.find_first_not_of(characters));
  rest.remove_prefix(taken.size());
  return taken;
}

/// [0-9]+(/[0-9]+)?
mpq_class fraction(std::string_view rest) {
  const auto above = take(rest, digits), bar = take(rest, "/"), below = take(rest, digits);
  demand(!above.empty() && bar == (below.empty() ? "" : "/") && rest.empty(), "a malformed number");
  mpq_class value(mpz_class(std::string(above), 10));
  if (below.empty()) return value;
  value.get_den() = mpz_class(std::string(below), 10);
  demand(value.get_den() != 0, "a denominator of zero");
  value.canonicalize();
  return value;
}

/// [01](\.[0-9a-f]+)?p[+-]?[0-9]+
mpq_class hexadecimal(std::string_view rest) {
  const auto bit = take(rest, "01"), point = take(rest, "."), part = take(rest, "0123456789abcdef");
  const auto p = take(rest, "p"), sign = take(rest, "+-"), power = take(rest, digits);
  demand(bit.size() == 1 && point == (part.empty() ? "" : ".") && p == "p", "a malformed number");
  demand(sign.size() <= 1 && !power.empty() && rest.empty(), "a malformed number");
  const unsigned long exponent = power.size() <= 4 ? std::stoul(std::string(power)) : 9999;
  demand(exponent <= 1074, "an exponent beyond a double's");
  mpq_class value(mpz_class(std::string(bit).append(part), 16));
  sign == "-" ? value >>= exponent : value <<= exponent;
  value >>= 4 * part.size();
  exact_double(value);
  return value;
}

mpq_class number(std::string_view text) {
  demand(text.size() <= 10'000, "a number of more than 10,000 characters");
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  mpq_class value = text.starts_with("0x") ? hexadecimal(text.substr(2)) : fraction(text);
  if (negative) value = -value;
  return value;
}

/// The JSON library's message, without the error's name at its beginning, such as
/// "[json.exception.parse_error.101] ".
std::string message(const Json::exception& error) {
  const std::string_view text = error.what();
  return std::string(text.substr(text.find("] ") + 2));
}

/// The JSON library's parser does not recurse, and calls `look` for each bracket, key and value.
Json parse(std::string_view line) try {
  if (line.size() > longest_line) throw Unreadable("a line of more than 512 KiB");
  // The library would take a zero byte for the end of the line.
  if (!std::ranges::all_of(line, [](unsigned char c) { return 0 < c && c < 128 && c != '\\'; }))
    throw Unreadable("a backslash, or not ASCII");
  std::size_t keys = 0;
  int deepest = 0;
  const auto look = [&](int depth, Json::parse_event_t event, const Json&) {
    deepest = std::max(deepest, depth);
    keys += event == Json::parse_event_t::key ? 1 : 0;
    return true;
  };
  Json object = Json::parse(line, look);
  if (!object.is_object()) throw Unreadable("not a JSON object");
  demand(deepest <= 4, "brackets nested too deeply");
  demand(keys == object.size(), "a key that occurs twice, or an object inside the object");
  return object;
} catch (const Json::exception& error) {
  throw Unreadable(message(error));
}

void demand_keys(const Json& object, std::initializer_list<const char*> own) {
  std::size_t known = 0;
  for (const char* key : {"kind", "x", "h", "claim", "from", "to", "query"}) known += object.count(key);
  for (const char* key : own) known += object.count(key);
  demand(known == object.size(), "a key that is unknown, or of another claim");
}

/// Reads the statement that the line should prove. If a key is missing or a value has a wrong type, the JSON
/// library throws an exception.
Statement read_statement(const Json& object) {
  Statement is;
  object.at("kind").get_to(is.kind);
  for (const mpq_class& each : object.at("x").get<Rationals>()) is.x.push_back(exact_double(each));
  is.h = exact_double(object.at("h").get<mpq_class>());
  object.at("claim").get_to(is.claim);
  object.at("from").get_to(is.from);
  object.at("to").get_to(is.to);
  is.open = object.value("open", false);
  is.strict = object.value("strict", is.claim == "apart");
  object.value("query", std::string());
  demand(is.h >= 0, "a negative h");
  demand(0 <= is.from && is.from <= is.to && is.to <= 1, "not 0 <= from <= to <= 1");
  return is;
}

/// The rows, multiplied by one positive integer that makes all numbers integers, and padded with zeros to the
/// same length.
std::vector<Integers> integers(const std::vector<Rationals>& rows) {
  mpz_class scale = 1;
  std::size_t size = 0;
  for (const Rationals& row : rows) size = std::max(size, row.size());
  for (const Rationals& row : rows)
    for (const mpq_class& each : row) scale = lcm(scale, each.get_den());
  std::vector<Integers> all(rows.size(), Integers(size));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      all[i][j] = rows[i][j].get_num() * (scale / rows[i][j].get_den());
  return all;
}

// Below, the Integers f are the coefficients of a polynomial f[0] + f[1] t + ... in the time t. Its degree is
// f.size() - 1, even if the last coefficients are 0. The components of a Vector are such polynomials.
using Vector = std::array<Integers, 3>;

Integers product(const Integers& f, const Integers& g) {
  Integers sum(f.size() + g.size() - 1);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j)
      mpz_addmul(sum[i + j].get_mpz_t(), f[i].get_mpz_t(), g[j].get_mpz_t());
  return sum;
}

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Integers dot(const Vector& a, const Vector& b) {
  return product(a[0], b[0]) + product(a[1], b[1]) + product(a[2], b[2]);
}

Vector cross(const Vector& a, const Vector& b) {
  const auto component = [&](std::size_t i, std::size_t j) {
    return Integers(product(a[i], b[j]) - product(a[j], b[i]));
  };
  return {component(1, 2), component(2, 0), component(0, 1)};
}

/// The times from p = P / D to q = Q / D, as {{P, Q}, {D, D}}.
using Piece = std::vector<Integers>;
Piece piece(const mpq_class& p, const mpq_class& q) { return integers({{p, q}, {1, 1}}); }

/// The Bernstein coefficients b[i] of f over [p, q], each times a positive factor. For u, v >= 0, not both 0,
/// t = (P u + Q v) / (D u + D v) takes all values in [p, q] and no others, and by Horner's rule
///   (D u + D v)^m f(t) = b[0] u^m + b[1] u^(m-1) v + ... + b[m] v^m    for f of degree m.
/// So if all b[i] > 0, f > 0 on [p, q]. If all b[i] >= 0, f >= 0 on [p, q]. If also b[0] > 0, f > 0 on
/// [p, q), because u > 0 there. b[0] has the sign of f(p), and b[m] has the sign of f(q).
Integers bernstein(const Integers& f, const Piece& piece) {
  Integers b(f[f.size() - 1], 1), power(1, 1);
  for (std::size_t i = f.size() - 1; i-- > 0;) {
    power = product(power, piece[1]);
    b = product(b, piece[0]) + f[i] * power;
  }
  return b;
}

bool positive(const Integers& f, const Piece& piece) { return bernstein(f, piece).min() > 0; }

/// The statement's query in integers: all lengths are multiplied by one positive integer.
struct Query {
  std::size_t a;          // A has the first a vertices, B the others
  std::vector<Vector> x;  // the vertices; each coordinate is a polynomial of degree 1
  mpz_class h;
};

Query read_query(const Statement& statement) {
  static const std::map<std::string, std::array<std::size_t, 2>> kinds = {
      {"vv", {1, 2}}, {"ve", {1, 3}}, {"vt", {1, 4}}, {"ee", {2, 4}}};
  demand(kinds.contains(statement.kind), "an unknown kind");
  const auto [a, count] = kinds.at(statement.kind);
  demand(statement.x.size() == 6 * count, "a number of coordinates that does not fit the kind");
  std::vector<Rationals> rows = {{statement.h}};
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const mpq_class start = statement.x[i], end = statement.x[3 * count + i];
    rows.push_back({start, end - start});
  }
  const auto c = integers(rows);
  Query query = {a, {}, c[0][0]};
  for (std::size_t v = 0; v < count; ++v) query.x.push_back({c[3 * v + 1], c[3 * v + 2], c[3 * v + 3]});
  return query;
}

/// Proves dist > h on the piece: tests whether n . d > h |n| for all differences d of a vertex of A and a
/// vertex of B, by comparing n . d with 0 and (n . d)^2 with h^2 n . n. The difference d of any point of A
/// and any point of B is a convex combination of the tested differences, so n . d > h |n| holds for this d,
/// too. So n is not 0, and |d| > h, because n . d <= |n| |d|. If `strict` is false, tests n . d > 0 and n . d
/// >= h |n|, which proves |d| >= h. If `open` is true, the tests cover all times of the piece except its end.
void prove_piece(const Piece& piece, const Vector& n, const Query& query, bool strict, bool open) {
  const auto enough = [open](const Integers& b) { return b[0] > 0 && (open ? b.min() >= 0 : b.min() > 0); };
  const Integers limit = query.h == 0 ? Integers() : mpz_class(query.h * query.h) * dot(n, n);
  for (std::size_t i = 0; i < query.a; ++i)
    for (std::size_t j = query.a; j < query.x.size(); ++j) {
      const Integers along = dot(n, query.x[i] - query.x[j]);
      demand(enough(bernstein(along, piece)), "n . d that is not positive");
      if (query.h == 0) continue;
      Integers excess = product(along, along);
      excess[std::slice(0, limit.size(), 1)] -= limit;
      const Integers b = bernstein(excess, piece);
      demand(strict ? enough(b) : b.min() >= 0, "n . d that is too small for h");
    }
}

/// The normal n(t), times a positive integer.
Vector read_normal(const std::vector<Rationals>& n) {
  demand(n.size() == 3, "a normal that has not three components");
  for (const auto& f : n) demand(!f.empty() && f.size() <= 5, "a polynomial without 1 to 5 coefficients");
  const auto rows = integers(n);
  return {rows[0], rows[1], rows[2]};
}

/// Proves that the pieces cover [from, to] without a gap, and that the claim holds on each piece.
void prove_apart(const Json& proof, const Query& query, const Statement& claim) {
  demand_keys(proof, {"times", "normals", "open", "strict"});
  const auto times = proof.at("times").get<Rationals>();
  std::vector<Vector> normals;
  for (auto& n : proof.at("normals").get<std::vector<std::vector<Rationals>>>())
    normals.push_back(read_normal(n));
  demand(!normals.empty() && normals.size() <= 20'000, "no piece, or more than 20,000");
  demand(times.size() == normals.size() + 1, "a number of times that does not fit");
  demand(std::ranges::is_sorted(times), "times that decrease");
  demand(times.front() == claim.from && times.back() == claim.to, "times that do not cover [from, to]");
  demand(!claim.open || times.end()[-2] < times.back(), "an open claim whose last piece is a single time");
  demand(claim.strict || query.h > 0, "a claim apart that is not strict, with h = 0");
  for (std::size_t i = 0; i < normals.size(); ++i)
    prove_piece(piece(times[i], times[i + 1]), normals[i], query, claim.strict,
                claim.open && i + 1 == normals.size());
}

/// Proves that, at a time in [from, to], a point of A and a point of B, given by weights, are near enough.
void prove_at(const Json& proof, const Query& query, const Statement& claim) {
  demand_keys(proof, {"at", "weights", "strict"});
  const auto t = proof.at("at").get<mpq_class>();
  const auto weights = proof.at("weights").get<Rationals>();
  demand(claim.from <= t && t <= claim.to, "a time outside [from, to]");
  demand(weights.size() == query.x.size(), "a wrong number of weights");
  mpq_class of_a = 0, of_b = 0;
  std::array<mpq_class, 3> gap;
  for (std::size_t v = 0; v < weights.size(); ++v) {
    demand(weights[v] >= 0, "a negative weight");
    (v < query.a ? of_a : of_b) += weights[v];
    for (std::size_t k = 0; k < 3; ++k)
      gap[k] += (v < query.a ? 1 : -1) * weights[v] * (query.x[v][k][0] + query.x[v][k][1] * t);
  }
  demand(of_a == 1 && of_b == 1, "weights whose sum is not 1");
  const mpq_class excess = gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2] - query.h * query.h;
  demand(claim.strict ? excess < 0 : excess <= 0, "points that are too far apart");
}

/// F and the weights w1, w2, w3 for a vertex and a triangle. With ai = xi - x0, w1 a1 + w2 a2 + w3 a3 = -F N
/// and w1 + w2 + w3 = N . N at all times. So when F = 0 and all weights are positive, x0 is the mean of x1,
/// x2 and x3 with these weights.
std::vector<Integers> vertex_triangle(const std::vector<Vector>& x) {
  const Vector N = cross(x[2] - x[1], x[3] - x[1]);
  const auto weight = [&](std::size_t j, std::size_t k) { return dot(N, cross(x[j] - x[0], x[k] - x[0])); };
  return {dot(N, x[0] - x[1]), weight(2, 3), weight(3, 1), weight(1, 2)};
}

/// F and the weights s, N . N - s, u, N . N - u for two edges. With e = x1 - x0 and f = x3 - x2,
/// s e - u f = (N . N) r - F N at all times. So when F = 0 and all weights are positive,
/// x0 + (s / N . N) e = x2 + (u / N . N) f, and both factors s / N . N and u / N . N are between 0 and 1.
std::vector<Integers> edge_edge(const std::vector<Vector>& x) {
  const Vector e = x[1] - x[0], f = x[3] - x[2], r = x[2] - x[0], N = cross(e, f);
  const Integers NN = dot(N, N), s = dot(N, cross(r, f)), u = dot(N, cross(r, e));
  return {dot(N, r), s, NN - s, u, NN - u};
}

/// Proves contact: F(p) F(q) <= 0, so F = 0 at a time in [p, q]. At this time, all weights are positive, and
/// so is N . N, which is a sum of weights.
void prove_crossing(const Piece& piece, const std::vector<Integers>& F_and_weights) {
  const Integers F = bernstein(F_and_weights[0], piece);
  demand(F[0] * F[3] <= 0, "an F that does not change its sign");
  for (std::size_t i = 1; i < F_and_weights.size(); ++i)
    demand(positive(F_and_weights[i], piece), "a weight that is not positive");
}

/// Proves that v is on the edge from y to z at a time in [p, q]. The coefficients of W = (v - y) x (z - y)
/// have rank 1, so W is a polynomial g(t) times a constant vector k. W(p) . W(q) = |k|^2 g(p) g(q) < 0, so
/// W = 0 at a time in [p, q]. At this time, v is on the line through y and z, and between y and z, because
/// (v - y) . (z - y) and (z - v) . (z - y) are positive.
void prove_on_edge(const Piece& piece, const Vector& v, const Vector& y, const Vector& z) {
  const Vector W = cross(v - y, z - y);
  mpz_class sign = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Integers &f = W[k], &g = W[(k + 1) % 3], b = bernstein(f, piece);
    for (std::size_t i = 0, j = 1; i < 3; ++i, j = (i + 1) % 3)
      demand(f[i] * g[j] == f[j] * g[i], "a rank above 1");
    sign += b[0] * b[2];
  }
  demand(sign < 0, "a cross product that does not change its sign");
  demand(positive(dot(v - y, z - y), piece), "a vertex that may be beyond y");
  demand(positive(dot(z - v, z - y), piece), "a vertex that may be beyond z");
}

/// Proves contact at a time in [p, q], which may be irrational.
void prove_bracket(const Json& proof, const Query& query, const Statement& claim) {
  demand_keys(proof, {"bracket", "edge"});
  const auto ends = proof.at("bracket").get<Rationals>();
  demand(ends.size() == 2 && ends[0] < ends[1], "no bracket");
  demand(claim.from <= ends[0] && ends[1] <= claim.to, "a bracket outside [from, to]");
  demand(query.h == 0, "a bracket with h > 0");
  const Piece within = piece(ends[0], ends[1]);
  const auto& x = query.x;
  if (!proof.contains("edge")) {
    demand(x.size() == 4, "a bracket of vv or ve without an edge");
    return prove_crossing(within, query.a == 1 ? vertex_triangle(x) : edge_edge(x));
  }
  std::vector<std::size_t> vyz;
  for (const auto& vertex : proof["edge"].get<std::vector<std::string>>()) {
    vyz.push_back(std::string("0123").find(vertex));
    demand(vertex.size() == 1 && vyz.back() < x.size(), "a vertex that the kind does not have");
  }
  demand(vyz.size() == 3, "an edge bracket that has not three vertices");
  const auto in_a = [&](std::size_t i) { return vyz[i] < query.a; };
  demand(in_a(0) != in_a(1) && in_a(1) == in_a(2), "not a vertex and an edge of different primitives");
  prove_on_edge(within, x[vyz[0]], x[vyz[1]], x[vyz[2]]);
}
}  // namespace

Statement check(std::string_view line) try {
  const Json object = parse(line);
  if (object.at("claim").is_null()) throw Refused("no certificate: " + object.at("why").get<std::string>());
  Statement statement = read_statement(object);
  const bool apart = statement.claim == "apart";
  demand(apart || statement.claim == "meets", "a claim that is neither apart nor meets");
  const auto prove = apart ? prove_apart : object.contains("at") ? prove_at : prove_bracket;
  prove(object, read_query(statement), statement);
  return statement;
} catch (const Json::exception& error) {
  throw Refused(message(error));
}
}  // namespace certificates

static void from_json(const Json& from, mpq_class& to) { to = certificates::number(from.get<std::string>()); }
