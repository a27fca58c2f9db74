"""How wrong cheaper methods can be: bounds of colour, of light and of samples, in linear light and in bytes."""
