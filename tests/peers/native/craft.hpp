// One spacecraft as its JSON file gives it: what every native runner starts from.
#pragma once

#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include <boost/json.hpp>

using Entries = std::array<double, 6>;  // 11, 12, 13, 22, 23, 33
using Components = std::array<double, 3>;

struct Body {
  double mass;
  Components centre;
  Entries inertia;
};

// A device's body with the place of its joint in the body before.
struct Link {
  Components origin;
  Body body;
};

struct Device {
  std::array<double, 9> mount;  // row by row; columns are the device's axes along B
  std::array<Link, 3> links;    // outer gimbal, inner gimbal, wheel
};

struct Craft {
  Body hub;
  std::vector<Device> devices;
  std::vector<double> angles, rates, motors;  // three a device
  Components r_b_n_dot, omega, force, torque_b;

  explicit Craft(const std::string& path);
};

namespace craft_json {

using Object = boost::json::object;

inline Components components(const boost::json::value& value) {
  return boost::json::value_to<Components>(value);
}

inline Components along(const Object& parameters, const std::string& name) {
  return {parameters.at(name + "x").to_number<double>(),
          parameters.at(name + "y").to_number<double>(),
          parameters.at(name + "z").to_number<double>()};
}

inline Entries inertia(const Object& parameters, const std::string& name) {
  const std::array<const char*, 6> entries{"_11", "_12", "_13", "_22", "_23", "_33"};
  Entries found;
  for (std::size_t k = 0; k < 6; ++k)
    found[k] = parameters.at(name + entries[k]).to_number<double>();
  return found;
}

inline Device device(const Object& given) {
  Device found;
  std::size_t k = 0;
  for (const auto& row : given.at("mount").as_array())
    for (const double x : components(row)) found.mount[k++] = x;
  const Object& p = given.at("parameters").as_object();
  const auto number = [&](const char* name) { return p.at(name).to_number<double>(); };
  found.links = {{
      {along(p, "r_go_b_b"), {number("m_go"), along(p, "r_goc_go_go"), inertia(p, "i_go")}},
      {along(p, "l_o_"), {number("m_gi"), along(p, "r_gic_gi_gi"), inertia(p, "i_gi")}},
      {along(p, "l_i_"), {number("m_w"), {0.0, number("d"), 0.0}, inertia(p, "j")}},
  }};
  return found;
}

inline boost::json::value parsed(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    std::cerr << path << ": not to be read\n";
    std::exit(1);
  }
  return boost::json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
}

}  // namespace craft_json

inline Craft::Craft(const std::string& path) {
  using namespace craft_json;
  const boost::json::value whole = parsed(path);
  const Object& given = whole.as_object();
  const Object& g_hub = given.at("hub").as_object();
  hub = {g_hub.at("m_b").to_number<double>(), components(g_hub.at("r_bc_b")),
         boost::json::value_to<Entries>(g_hub.at("i_b"))};
  for (const auto& value : given.at("devices").as_array()) {
    const Object& one = value.as_object();
    devices.push_back(device(one));
    const auto append = [&](const char* what, std::vector<double>& to) {
      for (const auto& joint : one.at(what).as_object())
        to.push_back(joint.value().to_number<double>());
    };
    append("angles", angles);
    append("rates", rates);
    append("motors", motors);
  }
  r_b_n_dot = components(given.at("r_b_n_dot"));
  omega = components(given.at("omega"));
  force = components(given.at("force"));
  torque_b = components(given.at("torque_b"));
}
