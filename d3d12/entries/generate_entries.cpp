// SPDX-License-Identifier: MIT
// kaamos-d3d12-entries OUTPUT_DIR HEADER...: reads COM interfaces from headers as MIDL writes them,
// and writes for every chain of versions a class in which each method says that it is missing. The
// objects of this library derive from those classes and override what works, so that a program
// always reaches an entry, with whatever version of the headers it is built.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Method {
  std::string result;
  std::string name;
  std::string parameters;  // as in the header, on one line; empty: none
};

struct Interface {
  std::string name;
  std::string base;  // empty: none
  std::string guid;  // 8-4-4-4-12
  std::vector<Method> methods;
};

std::string collapse(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (!std::isspace(static_cast<unsigned char>(c))) {
      out += c;
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

// Takes the first branch of `#if defined(_MSC_VER) || !defined(_WIN32)`, as programs do.
std::string choose_branches(const std::string& body) {
  std::istringstream in(body);
  std::string out, line;
  bool skipping = false;
  while (std::getline(in, line)) {
    if (line.starts_with("#if")) {
      skipping = false;
    } else if (line.starts_with("#else")) {
      skipping = true;
    } else if (line.starts_with("#endif")) {
      skipping = false;
    } else if (!skipping) {
      out += line + '\n';
    }
  }
  return std::regex_replace(out, std::regex(R"(/\*[^*]*\*/|DECLSPEC_XFGVIRT\([^)]*\))"), "");
}

std::vector<Method> read_methods(const std::string& body) {
  static const std::regex kVirtual(
      R"(virtual\s+([\w\s\*]+?)\s*\bSTDMETHODCALLTYPE\s+(\w+)\s*\(([^;]*?)\)\s*=\s*0;)");
  std::vector<Method> methods;
  const std::string text = choose_branches(body);
  for (std::sregex_iterator it(text.begin(), text.end(), kVirtual), end; it != end; ++it) {
    std::string parameters = collapse((*it)[3]);
    if (parameters == "void" || parameters == " void" || parameters == " ") parameters.clear();
    methods.push_back({collapse((*it)[1]), (*it)[2], parameters});
  }
  return methods;
}

// False if there is none.
bool read_header(const std::string& text, std::vector<Interface>& interfaces) {
  bool found = false;
  static const std::regex kInterface(
      R"re(MIDL_INTERFACE\("([0-9A-Fa-f-]{36})"\)\s*(\w+)\s*(?::\s*public\s+(\w+))?\s*\{)re");
  for (std::sregex_iterator it(text.begin(), text.end(), kInterface), end; it != end; ++it) {
    found = true;
    const size_t start = it->position() + it->length();
    const size_t stop = text.find("};", start);
    // A newer header of Microsoft's has what ours declares for older ones.
    const std::string name = (*it)[2];
    if (std::ranges::any_of(interfaces, [&](const Interface& i) { return i.name == name; }))
      continue;
    interfaces.push_back(
        {(*it)[2], (*it)[3], (*it)[1], read_methods(text.substr(start, stop - start))});
  }
  return found;
}

// "ID3D12Device" of "ID3D12Device11".
std::string stem(const std::string& name) {
  const size_t last = name.find_last_not_of("0123456789");
  return name.substr(0, last + 1);
}

std::string guid_initializer(const std::string& guid) {
  std::string hex = guid;
  std::erase(hex, '-');
  std::string out =
      "{0x" + hex.substr(0, 8) + "u, 0x" + hex.substr(8, 4) + ", 0x" + hex.substr(12, 4) + ", {";
  for (size_t i = 16; i < 32; i += 2) out += (i > 16 ? ", 0x" : "0x") + hex.substr(i, 2);
  return out + "}}";
}

class Chains {
 public:
  explicit Chains(std::vector<Interface> interfaces) : interfaces_(std::move(interfaces)) {
    for (const Interface& i : interfaces_) by_name_[i.name] = &i;
  }

  // Interfaces that no other derives from.
  std::vector<const Interface*> newest() const {
    std::vector<const Interface*> out;
    for (const Interface& i : interfaces_) {
      const bool base_of_another =
          std::ranges::any_of(interfaces_, [&](const Interface& o) { return o.base == i.name; });
      if (!base_of_another && i.name != "IUnknown") out.push_back(&i);
    }
    return out;
  }

  // An interface and what it derives from, without IUnknown.
  std::vector<const Interface*> chain(const Interface& newest) const {
    std::vector<const Interface*> out;
    for (const Interface* i = &newest; i != nullptr;) {
      out.push_back(i);
      auto base = by_name_.find(i->base);
      i = base == by_name_.end() || i->base == "IUnknown" ? nullptr : base->second;
    }
    return out;
  }

  const std::vector<Interface>& all() const { return interfaces_; }

 private:
  std::vector<Interface> interfaces_;
  std::map<std::string, const Interface*> by_name_;
};

void write_method(std::ostream& out, const Interface& interface, const Method& method) {
  const std::string name = "\"" + interface.name + "::" + method.name + "\"";
  out << "  " << method.result << " STDMETHODCALLTYPE " << method.name << "(" << method.parameters
      << ") override {\n    ";
  if (method.result == "HRESULT") {
    out << "return reporter().missing(" << name << ");\n";
  } else if (method.result == "void") {
    out << "reporter().missing(" << name << ");\n";
  } else {
    out << "reporter().missing(" << name << ");\n    return {};\n";
  }
  out << "  }\n";
}

void write_entries(std::ostream& out, const Chains& chains) {
  out << "// Made by kaamos-d3d12-entries. Every method of every interface, saying that it is "
         "missing.\n#pragma once\n\n#include \"d3d12/com/interface_id.h\"\n"
         "#include \"d3d12/com/report.h\"\n#include <kaamos_d3d12_interfaces.h>\n\nnamespace "
         "kaamos::d3d12 {\n";
  for (const Interface* newest : chains.newest()) {
    const auto chain = chains.chain(*newest);
    // The name of the oldest version: ID3D12DeviceEntries has the methods of ID3D12Device11.
    const Interface* oldest = chain.front();
    for (const Interface* i : chain) {
      if (stem(i->name) == stem(newest->name)) oldest = i;
    }
    out << "\nclass " << oldest->name << "Entries : public " << newest->name << " {\n public:\n"
        << "  using EntriesClass = " << oldest->name << "Entries;\n"
        << "  static constexpr InterfaceId kInterfaces[] = {\n";
    for (const Interface* i : chain) {
      out << "      {" << guid_initializer(i->guid) << ", \"" << i->name << "\"},\n";
    }
    out << "  };\n";
    for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
      for (const Method& method : (*i)->methods) write_method(out, **i, method);
    }
    out << "\n protected:\n  virtual Reporter& reporter() const = 0;\n  virtual ~" << oldest->name
        << "Entries() = default;\n};\n";
  }
  out << "\n}  // namespace kaamos::d3d12\n";
}

void write_ids(std::ostream& out, const Chains& chains) {
  out << "// Made by kaamos-d3d12-entries. The ids of all interfaces.\n"
         "#include <unknwn.h>\n\nextern \"C\" {\n";
  for (const Interface& i : chains.all()) {
    out << "extern const IID IID_" << i.name << ";\nconst IID IID_" << i.name << " = "
        << guid_initializer(i.guid) << ";\n";
  }
  out << "}\n";
}

void write_methods(std::ostream& out, const Chains& chains) {
  out << "// Made by kaamos-d3d12-entries: KAAMOS_METHOD(interface, method) of every method.\n";
  for (const Interface& i : chains.all()) {
    for (const Method& method : i.methods) {
      out << "KAAMOS_METHOD(" << i.name << ", " << method.name << ")\n";
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: kaamos-d3d12-entries OUTPUT_DIR HEADER...\n";
    return 2;
  }
  std::vector<Interface> interfaces;
  for (int i = 2; i < argc; ++i) {
    std::ifstream in(argv[i]);
    if (!in) {
      std::cerr << "kaamos-d3d12-entries: cannot read " << argv[i] << "\n";
      return 1;
    }
    std::ostringstream text;
    text << in.rdbuf();
    if (!read_header(text.str(), interfaces)) {
      std::cerr << "kaamos-d3d12-entries: no MIDL_INTERFACE in " << argv[i] << "\n";
      return 1;
    }
  }
  const Chains chains(std::move(interfaces));
  const std::string directory = argv[1];
  std::ofstream entries(directory + "/d3d12_entries.h"), ids(directory + "/d3d12_ids.cpp"),
      methods(directory + "/d3d12_methods.inc");
  write_entries(entries, chains);
  write_ids(ids, chains);
  write_methods(methods, chains);
  if (!entries.flush() || !ids.flush() || !methods.flush()) {
    std::cerr << "kaamos-d3d12-entries: cannot write to " << directory << "\n";
    return 1;
  }
  return 0;
}
