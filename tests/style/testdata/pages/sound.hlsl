float first;
float second;
float third;
