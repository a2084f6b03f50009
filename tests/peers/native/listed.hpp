// A spacecraft with its devices listed by kind and bodies, as `steps/*.json` has it, for the C library.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "craft.hpp"
#include "precess.h"

struct Listed {
  precess_hub hub{};
  std::vector<precess_device> devices;
  // Joints of each device, coordinate and rate of each, and torque of its motor.
  std::vector<std::size_t> joints;
  double coordinate[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]{};
  double rate[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]{};
  double motor[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]{};
  Components omega, force, torque_b;
  double step;

  explicit Listed(const std::string& path);
};

namespace listed_json {

using Object = boost::json::object;

inline void copy(const Components& from, double* to) { std::copy(from.begin(), from.end(), to); }

// All nine entries from 11, 12, 13, 22, 23, 33.
inline void copy_tensor(const boost::json::value& value, double* to) {
  const auto e = boost::json::value_to<Entries>(value);
  const std::array<double, 9> all{e[0], e[1], e[2], e[1], e[3], e[4], e[2], e[4], e[5]};
  std::copy(all.begin(), all.end(), to);
}

inline precess_device device(const Object& given) {
  static const std::map<std::string, int32_t> kinds{
      {"dgvscmg", PRECESS_KIND_DGVSCMG},
      {"vscmg", PRECESS_KIND_VSCMG},
      {"reaction_wheel", PRECESS_KIND_REACTION_WHEEL}};
  precess_device made{};
  made.kind = kinds.at(given.at("kind").as_string().c_str());
  std::size_t k = 0;
  for (const auto& row : given.at("mount").as_array())
    for (const double x : craft_json::components(row)) made.mount[k++] = x;
  k = 0;
  for (const auto& body : given.at("bodies").as_array()) {
    precess_body& to = made.bodies[k++];
    to.mass = body.at("mass").to_number<double>();
    copy(craft_json::components(body.at("origin")), to.origin);
    copy(craft_json::components(body.at("centre")), to.centre);
    copy_tensor(body.at("inertia"), to.inertia);
  }
  return made;
}

}  // namespace listed_json

inline Listed::Listed(const std::string& path) {
  using namespace listed_json;
  const boost::json::value whole = craft_json::parsed(path);
  const Object& given = whole.as_object();
  const Object& g_hub = given.at("hub").as_object();
  hub.mass = g_hub.at("mass").to_number<double>();
  copy(craft_json::components(g_hub.at("centre")), hub.centre);
  copy_tensor(g_hub.at("inertia"), hub.inertia);
  for (const auto& value : given.at("devices").as_array()) {
    const Object& one = value.as_object();
    const auto fill = [&](const char* what, double* to) {
      for (const auto& number : one.at(what).as_array()) *to++ = number.to_number<double>();
    };
    const std::size_t k = devices.size();
    devices.push_back(device(one));
    joints.push_back(one.at("rates").as_array().size());
    fill("coordinates", coordinate[k]);
    fill("rates", rate[k]);
    fill("motors", motor[k]);
  }
  omega = craft_json::components(given.at("omega"));
  force = craft_json::components(given.at("force"));
  torque_b = craft_json::components(given.at("torque_b"));
  step = given.at("step").to_number<double>();
}
