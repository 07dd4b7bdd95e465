// Comments may name ids: KA0790, "KA0790".
rtapi::Error fine() {
  return make_error(Id::kUpdate, "it was built without ALLOW_UPDATE");  // "KA0793 ..."
}
rtapi::Error spelled_out() {
  return {{}, rtapi::ErrorCode::kFailed, "KA0793 cannot be updated: it was built without it"};
}
rtapi::Error after_others(const std::string& name) {
  return fail("\"" + name + "\": see https://example.org", "(KA0793)");
}
