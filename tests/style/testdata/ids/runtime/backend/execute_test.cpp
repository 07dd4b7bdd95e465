TEST(Execute, TestsMayNameIds) {
  EXPECT_ERROR(update(), "KA0793");
}
