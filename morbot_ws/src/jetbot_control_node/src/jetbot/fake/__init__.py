"""Hardware that is not there: an I2C bus in a folder, its chips, and the motors behind them."""
