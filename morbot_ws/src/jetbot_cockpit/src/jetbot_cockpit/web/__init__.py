"""Between the browsers and a session: addresses, who gets in, what is served, and the sockets of the pages."""
