/* A program that does nothing: what starts of others are measured against. */
int main(void) {
    return 0;
}
