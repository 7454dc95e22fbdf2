namespace packbed {}
