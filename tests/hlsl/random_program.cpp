// SPDX-License-Identifier: MIT
#include "random_program.h"

#include <random>
#include <vector>

namespace kaamos::test {
namespace {

struct Shape {
  char kind = 'i';  // i int, u uint, f float, b bool, h float16_t, d double, l int64_t, s uint16_t
  int columns = 1;
  int rows = 0;   // 0: no matrix
  int count = 0;  // 0: no array
  bool operator==(const Shape&) const = default;

  bool is_long() const { return columns > 4; }
  bool real() const { return kind == 'f' || kind == 'h' || kind == 'd'; }
  Shape scalar() const { return {kind}; }
  Shape with(char other) const { return {other, columns, rows, count}; }
  Shape element() const { return {kind, columns, rows}; }
  std::string name() const {
    std::string out = kind == 'i'   ? "int"
                      : kind == 'u' ? "uint"
                      : kind == 'f' ? "float"
                      : kind == 'b' ? "bool"
                      : kind == 'h' ? "float16_t"
                      : kind == 'd' ? "double"
                      : kind == 'l' ? "int64_t"
                                    : "uint16_t";
    if (rows > 0) return out + std::to_string(rows) + "x" + std::to_string(columns);
    if (is_long()) return "vector<" + out + ", " + std::to_string(columns) + ">";
    return columns > 1 ? out + std::to_string(columns) : out;
  }
};

struct Variable {
  std::string name;
  Shape shape;
};

struct Function {
  std::string name;
  Shape result;
  std::vector<Shape> parameters;
  size_t inouts = 0;  // the first inout parameter
};

class Writer {
 public:
  explicit Writer(uint64_t seed) : random_(seed) {}

  std::string program() {
    text_ =
        "RWByteAddressBuffer results : register(u0);\n"
        "ByteAddressBuffer input : register(t0);\nstatic int nought = 0;\n"
        "static int varying = 0;\nstatic float drift = 0;\n"
        "uint bits(float x) { return isnan(x) ? 0x7fc00000u : abs(x) < 1.2e-38 ? 0u : asuint(x); "
        "}\n"
        "uint bits(int x) { return asuint(x); }\nuint bits(uint x) { return x; }\n"
        "uint bits(bool x) { return x ? 1u : 0u; }\n"
        "uint bits(float16_t x) { return abs((float)x) < 6.2e-5 ? 0u : bits((float)x); }\n"
        "uint bits(double x) { uint low, high; asuint(x, low, high); return x != x ? 1u : x == 0 ? "
        "0u : low ^ high * 3u; }\n"
        "uint bits(int64_t x) { return (uint)x ^ (uint)(x >> 32) * 3u; }\n"
        "uint bits(uint16_t x) { return (uint)x; }\n"
        "uint mix(uint h, uint v) { return (h ^ v) * 16777619u; }\n";
    for (int i = 0; i < 3; ++i) statics_.push_back(declare_static(i));
    write_struct();
    for (int i = 0; i < 3; ++i) function();
    main();
    return text_;
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<uint64_t>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  template <size_t N>
  const char* any(const char* const (&words)[N]) {
    return words[below(N)];
  }
  std::string number(int n) { return std::to_string(n); }

  Shape any_shape() {
    Shape s{"iuffbiuhdls"[below(11)], 1 + below(4)};
    if (s.kind != 'b' && one_in(4)) {
      s.rows = 2 + below(3);
      s.columns = 2 + below(3);
    } else if (one_in(5)) {
      s = long_vector(s.kind);
    }
    return s;
  }
  Shape any_vector(char kind) {
    if (one_in(5)) return long_vector(kind);
    return {kind, 1 + below(4)};
  }
  Shape long_vector(char kind) { return {kind, 5 + below(4)}; }

  std::string literal(Shape s) {
    if (s.kind == 'b') return one_in(2) ? "true" : "false";
    if (s.real()) {
      constexpr const char* kFloats[] = {"0.5", "-1.0", "2.0", "3.25", "-7.5", "1024.0", "0.0"};
      return any(kFloats);
    }
    constexpr const char* kInts[] = {"0", "1", "-1", "7", "31", "33", "0x7fffffff", "-12345"};
    constexpr const char* kUints[] = {"0u", "1u", "2u", "31u", "33u", "0xffffffffu", "12345u"};
    return s.kind == 'i' || s.kind == 'l' ? any(kInts) : any(kUints);
  }

  const Variable* find(Shape s) {
    std::vector<const Variable*> found;
    for (const auto* list : {&locals_, &statics_}) {
      for (const Variable& v : *list) {
        if (v.shape == s) found.push_back(&v);
      }
    }
    return found.empty() ? nullptr
                         : found[static_cast<size_t>(below(static_cast<int>(found.size())))];
  }

  std::string index() {
    // Computed, because a constant index out of range would be a compile error.
    return one_in(3) ? number(below(2)) : "((" + expression({'i'}, 1) + " + nought) & 7)";
  }

  std::string leaf(Shape s) {
    if (const Variable* v = find(s); v != nullptr && !one_in(5)) return v->name;
    Shape array = s;
    array.count = 3;
    if (const Variable* v = find(array); v != nullptr && one_in(2))
      return v->name + "[" + index() + "]";
    if (one_in(2)) return "((" + s.name() + ")" + any({"varying", "drift"}) + ")";
    if (s.rows > 0 || s.columns > 1) return "((" + s.name() + ")" + literal(s) + ")";
    if (s.kind == 'u' && one_in(2)) return "input.Load(" + expression({'u'}, 0) + " & 0x7fc)";
    return "((" + s.name() + ")" + literal(s) + ")";
  }

  std::string swizzle(int from, int count, bool repeats) {
    std::string letters = std::string("xyzw").substr(0, static_cast<size_t>(from));
    std::string out = ".";
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<size_t>(below(static_cast<int>(letters.size())));
      out += letters[at];
      if (!repeats) letters.erase(at, 1);
    }
    return out;
  }

  std::string matrix(Shape s, int depth) {
    const auto e = [&](Shape shape) { return expression(shape, depth - 1); };
    switch (below(7)) {
      case 0:
        return "(" + e(s) + any({" + ", " - ", " * "}) + e(s) + ")";
      case 1:
        return "transpose(" + e({s.kind, s.rows, s.columns}) + ")";
      case 2: {
        const int inner = 2 + below(3);
        return "mul(" + e({s.kind, inner, s.rows}) + ", " + e({s.kind, s.columns, inner}) + ")";
      }
      case 3: {
        std::string out = s.name() + "(";
        for (int r = 0; r < s.rows; ++r) out += (r == 0 ? "" : ", ") + e({s.kind, s.columns});
        return out + ")";
      }
      case 4:
        return "((" + s.name() + ")" + e({s.kind, s.columns < 4 ? s.columns + 1 : 4, 4}) + ")";
      case 5:
        return "(-" + e(s) + ")";
      default:
        return leaf(s);
    }
  }

  std::string boolean(Shape s, int depth) {
    const auto e = [&](Shape shape) { return expression(shape, depth - 1); };
    const Shape operand = s.with("iufiufhdls"[below(10)]);
    switch (below(6)) {
      case 0:
        if (s.columns == 1) return "(" + e(s) + any({" && ", " || "}) + e(s) + ")";
        return std::string(any({"and", "or"})) + "(" + e(s) + ", " + e(s) + ")";
      case 1:
        return "(!" + e(s) + ")";
      case 2:
        if (s.columns == 1)
          return std::string(any({"any", "all"})) + "(" + e(any_vector('b')) + ")";
        return leaf(s);
      default:
        return "(" + e(operand) + any({" < ", " <= ", " > ", " >= ", " == ", " != "}) + e(operand) +
               ")";
    }
  }

  std::string arithmetic(Shape s, int depth) {
    const auto e = [&](Shape shape) { return expression(shape, depth - 1); };
    const bool real = s.real();
    switch (below(12)) {
      case 0:
      case 1:
      case 2:
        if (real) return "(" + e(s) + any({" + ", " - ", " * "}) + e(s) + ")";
        return "(" + e(s) +
               any({" + ", " - ", " * ", " / ", " % ", " & ", " | ", " ^ ", " << ", " >> "}) +
               e(s) + ")";
      case 3:
        return std::string(any({"min", "max"})) + "(" + e(s) + ", " + e(s) + ")";
      case 4:
        if (s.kind == 'd') return std::string(any({"abs", "-"})) + "(" + e(s) + ")";
        if (real)
          return std::string(any({"abs", "floor", "ceil", "trunc", "saturate", "-", "round"})) +
                 "(" + e(s) + ")";
        if (s.kind == 'u')
          return std::string(any({"countbits", "reversebits", "firstbithigh", "~"})) + "(" + e(s) +
                 ")";
        return std::string(any({"abs", "-", "~"})) + "(" + e(s) + ")";
      case 5:
        return "(" + e({'b'}) + " ? " + e(s) + " : " + e(s) + ")";
      case 6:
        return "select(" + e(s.with('b')) + ", " + e(s) + ", " + e(s) + ")";
      case 7: {
        const int from = 2 + below(3);
        if (s.is_long()) return leaf(s);
        return e({s.kind, from}) + swizzle(from, s.columns, true);
      }
      case 8:
        return "((" + s.name() + ")" + e(s.with("iufbhdls"[below(8)])) + ")";
      case 9:
        if (s.columns == 1) {
          const Shape operand = one_in(3) ? long_vector(s.kind) : Shape{s.kind, 3};
          return "dot(" + e(operand) + ", " + e(operand) + ")";
        }
        if (s.columns > 2)
          return s.name() + "(" + e({s.kind, 2}) + ", " + e({s.kind, s.columns - 2}) + ")";
        return s.name() + "(" + e(s.scalar()) + ", " + e(s.scalar()) + ")";
      case 10: {
        const int inner = 2 + below(3);
        if (s.columns == 1) {
          return e(one_in(3) ? long_vector(s.kind) : Shape{s.kind, 3}) + "[" + index() + "]";
        }
        if (s.is_long()) return leaf(s);
        if (one_in(3)) return e({s.kind, s.columns, inner}) + "[" + index() + "]";
        if (one_in(2))
          return "mul(" + e({s.kind, inner}) + ", " + e({s.kind, s.columns, inner}) + ")";
        return "mul(" + e({s.kind, inner, s.columns}) + ", " + e({s.kind, inner}) + ")";
      }
      default:
        return leaf(s);
    }
  }

  std::string expression(Shape s, int depth) {
    if (depth <= 0 || s.count > 0) return leaf(s);
    if (s.rows > 0) return matrix(s, depth);
    return s.kind == 'b' ? boolean(s, depth) : arithmetic(s, depth);
  }

  // ---------------------------------------------------------------------------------------------

  void line(const std::string& text) {
    text_ += std::string(static_cast<size_t>(indent_) * 2, ' ') + text + "\n";
  }

  std::string fresh() { return "v" + number(next_name_++); }

  Variable declare_static(int i) {
    const Shape s = any_shape();
    const Variable v{"g" + number(i), s};
    text_ += "static " + s.name() + " " + v.name + " = (" + s.name() + ")" + literal(s) + ";\n";
    return v;
  }

  void write_struct() {
    text_ += "struct Inner {\n";
    for (int i = 0; i < 3; ++i) {
      fields_.push_back({"f" + number(i), any_shape()});
      text_ += "  " + fields_.back().shape.name() + " " + fields_.back().name + ";\n";
    }
    text_ += "};\nstruct Outer {\n  Inner a[2];\n  float4 b;\n  Inner c;\n};\n";
  }

  void declare_local() {
    Shape s = any_shape();
    const std::string name = fresh();
    if (one_in(5) && s.kind != 'b') {
      s.count = 3;
      std::string values;
      for (int i = 0; i < 3; ++i) values += (i == 0 ? "" : ", ") + expression(s.element(), 1);
      line(s.name() + " " + name + "[3] = {" + values + "};");
    } else {
      line(s.name() + " " + name + " = " + expression(s, 3) + ";");
    }
    locals_.push_back({name, s});
  }

  void assign() {
    std::vector<Variable> places = locals_;
    places.insert(places.end(), statics_.begin(), statics_.end());
    for (const Variable& f : fields_) {
      places.push_back({"o.a[" + index() + "]." + f.name, f.shape});
      places.push_back({"o.c." + f.name, f.shape});
    }
    Variable place = places[static_cast<size_t>(below(static_cast<int>(places.size())))];
    Shape& s = place.shape;
    if (s.count > 0) {
      place.name += "[" + index() + "]";
      s.count = 0;
    }
    if (s.rows > 0 && one_in(2)) {
      place.name += "[" + index() + "]";
      s.rows = 0;
    }
    if (s.rows == 0 && s.columns > 1 && one_in(2)) {
      const int from = s.columns;
      if (s.is_long()) {  // has no swizzles
        place.name += "[" + index() + "]";
        s.columns = 1;
      } else if (one_in(3)) {
        place.name += "[" + index() + "]";
        s.columns = 1;
      } else {
        s.columns = 1 + below(from);
        place.name += swizzle(from, s.columns, false);
      }
    }
    const char* op = s.kind == 'b' || one_in(2) ? " = "
                     : s.real()                 ? any({" += ", " -= ", " *= "})
                                                : any({" += ", " *= ", " ^= ", " >>= "});
    if (s.rows > 0 && s.kind != 'b') op = any({" = ", " += ", " -= "});
    line(place.name + op + expression(s, 3) + ";");
  }

  void call() {
    if (functions_.empty()) return assign();
    const Function& f = functions_[static_cast<size_t>(below(static_cast<int>(functions_.size())))];
    std::string arguments;
    for (size_t i = 0; i < f.parameters.size(); ++i) {
      const Shape s = f.parameters[i];
      std::string argument;
      if (i < f.inouts) {
        const Variable* v = find(s);
        if (v == nullptr) {
          const std::string name = fresh();
          line(s.name() + " " + name + " = " + expression(s, 1) + ";");
          locals_.push_back({name, s});
          argument = name;
        } else {
          argument = v->name;
        }
      } else {
        argument = expression(s, 2);
      }
      arguments += (i == 0 ? "" : ", ") + argument;
    }
    const std::string name = fresh();
    line(f.result.name() + " " + name + " = " + f.name + "(" + arguments + ");");
    locals_.push_back({name, f.result});
  }

  void body(int depth, int statements) {
    ++indent_;
    const size_t mark = locals_.size();
    for (int i = 0; i < statements; ++i) statement(depth);
    locals_.resize(mark);
    --indent_;
  }

  void loop(int depth) {
    const std::string k = "k" + number(next_name_++);
    const std::string rounds = number(2 + below(2));
    const int form = below(3);
    if (form == 0) line("for (int " + k + " = 0; " + k + " < " + rounds + "; ++" + k + ") {");
    if (form == 1) line("int " + k + " = 0; while (" + k + "++ < " + rounds + ") {");
    if (form == 2) line("int " + k + " = 0; do {");
    ++loop_;
    body(depth - 1, 2 + below(2));
    if (one_in(2)) line("  if (" + expression({'b'}, 2) + ") " + any({"continue;", "break;"}));
    body(depth - 1, 1);
    --loop_;
    line(form == 2 ? "} while (" + k + "++ < " + rounds + ");" : "}");
  }

  void choose(int depth) {
    line("switch (" + expression({"iu"[below(2)]}, 2) + " & 3) {");
    for (int label = 0; label < 3; ++label) {
      line(label == 2 && one_in(2) ? "default: {" : "case " + number(label) + ": {");
      body(depth - 1, 1 + below(2));
      line(loop_ > 0 && one_in(4) ? "} continue;" : label == 2 || !one_in(3) ? "} break;" : "}");
    }
    line("}");
  }

  void statement(int depth) {
    if (--budget_ < 0) return;
    switch (below(depth > 0 ? 12 : 7)) {
      case 0:
      case 1:
        return declare_local();
      case 5:
        return call();
      case 7:
      case 8:
        line("if (" + expression({'b'}, 3) + ") {");
        body(depth - 1, 1 + below(3));
        line("} else {");
        body(depth - 1, 1 + below(2));
        return line("}");
      case 9:
      case 10:
        return loop(depth);
      case 11:
        return choose(depth);
      default:
        return assign();
    }
  }

  void function() {
    Function f{"function" + number(static_cast<int>(functions_.size())), any_shape(), {}, 0};
    f.inouts = static_cast<size_t>(below(3));
    const size_t count = f.inouts + static_cast<size_t>(below(3));
    std::string list;
    locals_.clear();
    for (size_t i = 0; i < count; ++i) {
      const Shape s = any_shape();
      f.parameters.push_back(s);
      const std::string name = fresh();
      locals_.push_back({name, s});
      list +=
          (i == 0 ? "" : ", ") + std::string(i < f.inouts ? "inout " : "") + s.name() + " " + name;
    }
    text_ += f.result.name() + " " + f.name + "(" + list + ") {\n";
    indent_ = 1;
    line("Outer o = (Outer)0;");
    budget_ = 12;
    for (int i = 0; i < 5; ++i) statement(1);
    line("if (" + expression({'b'}, 2) + ") return " + expression(f.result, 2) + ";");
    for (int i = 0; i < 2; ++i) statement(1);
    line("return " + expression(f.result, 2) + ";");
    text_ += "}\n";
    functions_.push_back(f);
  }

  void hash(const std::string& name, Shape s) {
    for (int i = 0; i < (s.count > 0 ? s.count : 1); ++i) {
      const std::string item = s.count > 0 ? name + "[" + number(i) + "]" : name;
      for (int r = 0; r < (s.rows > 0 ? s.rows : 1); ++r) {
        const std::string row = s.rows > 0 ? item + "[" + number(r) + "]" : item;
        for (int c = 0; c < s.columns; ++c) {
          const std::string part = s.columns > 1 ? row + "[" + number(c) + "]" : row;
          line("h = mix(h, bits(" + part + "));");
        }
      }
    }
    line("results.Store(id.x * 512 + " + number(4 * next_word_++) + ", h);");
  }

  void main() {
    text_ +=
        "[shader(\"compute\")]\n[numthreads(8, 1, 1)]\nvoid main(uint3 id : SV_DispatchThreadID) "
        "{\n";
    indent_ = 1;
    locals_.clear();
    line("Outer o = (Outer)0;");
    line("uint h = 2166136261u;");
    line("varying = (int)id.x - 3;");
    line("drift = varying * 1.5 + 0.25;");
    line("uint3 thread = id;");
    line("int seen = (int)id.x - 3;");
    line("float fraction = id.x * 0.5 - 1.75;");
    locals_ = {{"thread", {'u', 3}}, {"seen", {'i'}}, {"fraction", {'f'}}};
    budget_ = 40;
    for (int i = 0; i < 12; ++i) statement(2);
    for (const auto* list : {&locals_, &statics_}) {
      for (const Variable& v : *list) hash(v.name, v.shape);
    }
    for (const Variable& f : fields_) {
      hash("o.a[0]." + f.name, f.shape);
      hash("o.a[1]." + f.name, f.shape);
      hash("o.c." + f.name, f.shape);
    }
    text_ += "}\n";
  }

  std::mt19937_64 random_;
  std::string text_;
  int indent_ = 0;
  int next_name_ = 0;
  int next_word_ = 0;
  int budget_ = 0;
  int loop_ = 0;
  std::vector<Variable> locals_;
  std::vector<Variable> statics_;
  std::vector<Variable> fields_;  // of Inner
  std::vector<Function> functions_;
};

}  // namespace

std::string random_program(uint64_t seed) {
  return Writer(seed).program();
}

}  // namespace kaamos::test
