inline const char* kFull = "KA3001 too many lights";
